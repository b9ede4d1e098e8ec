// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/status/status_routes.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "app/model/status/condition.h"
#include "app/model/status/json.h"
#include "app/model/status/readings.h"
#include "app/model/status/utc_text.h"
#include "app/ports/web/status/metrics_text.h"

namespace orbwatch::app::web {

StatusRoutes::StatusRoutes(StatusNames names, Counters counters, std::string version,
                           std::chrono::nanoseconds timeout)
    : names_(std::move(names)),
      counters_(std::move(counters)),
      version_(std::move(version)),
      timeout_(timeout) {}

void StatusRoutes::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const auto utc = hal::to_utc(status.stamp);
  const std::lock_guard lock(mutex_);
  // Converted once per frame set, because conversions of the clocks differ by about a microsecond.
  if (status.frame_set != newest_.status.frame_set) newest_.utc = utc;
  newest_.status = status;
  newest_.received = now;
}

StatusRoutes::Newest StatusRoutes::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

void StatusRoutes::publish() {
  if (!feed_->is_wanted()) return;
  Item report;
  report.bytes = std::make_shared<const std::string>(newest_as_json());
  report.stamp = hal::Clock::now();
  feed_->publish(std::move(report));
}

std::string StatusRoutes::newest_as_json() const {
  const Newest newest = this->newest();
  const auto now = hal::Clock::now();
  auto components = status_readings({newest.status, names_, now, newest.utc});
  components.push_back(component_readings(kWebComponent, counters_.own(), now));
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  const auto stamp = utc_text(newest.utc);
  all["stamp"] = stamp ? nlohmann::ordered_json(*stamp) : nlohmann::ordered_json();
  all["age"] = to_json(age_s(newest.received, now));
  all.update(to_json(components));
  return all.dump();
}

Response StatusRoutes::status() const { return json_response(newest_as_json()); }

Response StatusRoutes::health() const {
  const Newest newest = this->newest();
  const bool is_stale = hal::Clock::now() - newest.received > timeout_;
  const Condition condition = condition_of(static_cast<const SystemStatus&>(newest.status));
  return body_response(kText, (is_stale ? "the pipeline does not report" : condition.text) + "\n",
                       is_stale ? 503 : 200);
}

Response StatusRoutes::metrics() const {
  const Newest newest = this->newest();
  const auto interfaces =
      counters_.interfaces ? counters_.interfaces() : std::vector<InterfaceMetric>();
  return body_response(kMetrics,
                       metrics_text({newest.status, names_, hal::Clock::now(), newest.utc},
                                    counters_.own(), interfaces, version_));
}

}  // namespace orbwatch::app::web
