// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/model/alignment.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app::web {

/// Serves states and pictures from which users judge alignments, which commands change. Pictures
/// are made on other threads: no thread of the server waits. Thread-safe.
class AlignRoutes {
 public:
  /// `source` outlives the routes' use; null: there is no camera to align.
  AlignRoutes(std::vector<std::string> cameras, AlignmentSource* source)
      : cameras_(std::move(cameras)), source_(source) {}

  std::vector<Route> routes();

 private:
  void serve_alignment(const ExchangePtr& exchange) const;
  void serve_direction(const ExchangePtr& exchange) const;
  void serve_picture(const ExchangePtr& exchange, bool is_view) const;
  Result<std::size_t> camera_of(const Request& request) const;
  Result<AlignmentPicture> picture_of(const Request& request, bool is_view) const;

  const std::vector<std::string> cameras_;
  AlignmentSource* const source_;
};

}  // namespace orbwatch::app::web
