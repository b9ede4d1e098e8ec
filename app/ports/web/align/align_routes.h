// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/ports/web/align/alignment_records.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/http/exchange.h"

namespace orbwatch::app::web {

/// Serves states and pictures from which users judge alignments, which commands change. Pictures
/// are made on other threads: no thread of the server waits. Thread-safe.
class AlignRoutes {
 public:
  /// `source` outlives the routes' use; null: there is no camera to align.
  AlignRoutes(std::vector<std::string> cameras, AlignmentSource* source)
      : cameras_(std::move(cameras)), source_(source) {}

  /// AlignmentAnswer with a tag, because pages request it repeatedly and it changes rarely.
  Response state() const;
  void ball(const CameraQuery& query, const ExchangePtr& exchange) const;
  void view(const CameraViewQuery& query, const ExchangePtr& exchange) const;
  /// Answers with two messages in the form of LiveStream.
  void pair(const CameraViewQuery& query, const ExchangePtr& exchange) const;
  Answered<DirectionAnswer> direction(const CameraPixelQuery& query) const;

 private:
  void request(const CameraQuery& query, AlignmentPicture picture,
               const ExchangePtr& exchange) const;

  const std::vector<std::string> cameras_;
  AlignmentSource* const source_;
};

}  // namespace orbwatch::app::web
