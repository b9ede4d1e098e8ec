// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/sink/interface_metric.h"
#include "app/model/status/status_report.h"
#include "app/ports/web/http/message.h"
#include "app/ports/web/status/status_schema.h"
#include "app/ports/web/status/web_statistics.h"
#include "app/ports/web/streams/feed.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::web {

inline constexpr std::string_view kMetrics = "text/plain; version=0.0.4; charset=utf-8";

/// Keeps and serves the newest status. Thread rule: accept on the pipeline's thread, which holds a
/// lock only for a copy; everything else on any thread.
class StatusRoutes {
 public:
  /// Counters reported beside the status; callable on any thread.
  struct Counters {
    std::function<WebStatistics()> own;
    std::function<std::vector<InterfaceMetric>()> interfaces;  ///< empty: none
  };

  /// `timeout`: time without a status after which the pipeline counts as silent.
  StatusRoutes(StatusNames names, Counters counters, std::string version,
               std::chrono::nanoseconds timeout);

  Response health() const;
  /// "stamp" in UTC or null, "age" of the pipeline's last report in seconds, then every component
  /// in the form of app/model/status/json.h.
  Response status() const;
  Response metrics() const;

  void accept(const Status& status);
  /// Passes the newest status to the feed while it has readers.
  void publish();
  const std::shared_ptr<Feed>& feed() const { return feed_; }
  /// Number of the selected recipe; 0: none yet.
  std::uint16_t recipe() const { return newest().status.recipe; }

 private:
  struct Newest {
    Status status;
    std::chrono::system_clock::time_point utc{};
    hal::TimePoint received;
  };

  Newest newest() const;
  std::string newest_as_json() const;

  const StatusNames names_;
  const Counters counters_;
  const std::string version_;
  const std::chrono::nanoseconds timeout_;
  mutable hal::PriorityMutex mutex_;
  Newest newest_;  ///< guarded by mutex_
  const std::shared_ptr<Feed> feed_ = std::make_shared<Feed>();
};

}  // namespace orbwatch::app::web
