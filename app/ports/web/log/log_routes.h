// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "app/ports/web/api/route.h"
#include "app/ports/web/log/log_records.h"

namespace orbwatch::app::web {

/// Serves the newest lines of the log. Thread-safe.
class LogRoutes {
 public:
  /// Null: the program keeps no lines.
  explicit LogRoutes(std::shared_ptr<const RecentLog> log) : log_(std::move(log)) {}

  Answered<LogAnswer> lines(const LogQuery& query) const;

 private:
  const std::shared_ptr<const RecentLog> log_;
};

}  // namespace orbwatch::app::web
