// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/ports/web/http/content_coding.h"
#include "app/ports/web/http/exchange.h"

namespace orbwatch::app::web {

/// A content that never changes, sent compressed to clients that accept this, with an entity tag.
/// Reentrant.
class FixedContent {
 public:
  FixedContent(std::string_view type, std::string_view content)
      : FixedContent(type, content, gzip(content)) {}
  /// `packed`: the content, compressed by gzip.
  FixedContent(std::string_view type, std::string_view content, std::string_view packed);

  void answer(const ExchangePtr& exchange) const;

 private:
  Bytes content_, packed_;
  std::string type_, tag_;
};

}  // namespace orbwatch::app::web
