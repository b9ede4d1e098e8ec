// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/fixed_content.h"

#include <memory>
#include <utility>

#include "app/ports/web/http/accepted_encoding.h"
#include "app/ports/web/http/entity_tag.h"

namespace orbwatch::app::web {

FixedContent::FixedContent(std::string_view type, std::string_view content, std::string_view packed)
    : content_(std::make_shared<const std::string>(content)),
      packed_(std::make_shared<const std::string>(packed)),
      type_(type),
      tag_(entity_tag(content)) {}

void FixedContent::answer(const ExchangePtr& exchange) const {
  const bool is_packed = accepts_gzip(exchange->request());
  Response response = body_response(type_, is_packed ? packed_ : content_);
  response.tag = tag_;
  response.headers.emplace_back("Vary", "Accept-Encoding");
  if (is_packed) response.headers.emplace_back("Content-Encoding", "gzip");
  exchange->answer(std::move(response));
}

}  // namespace orbwatch::app::web
