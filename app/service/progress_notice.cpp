// SPDX-License-Identifier: Apache-2.0
#include "app/service/progress_notice.h"

#include <algorithm>
#include <utility>

#include "app/model/status/condition.h"
#include "app/service/service_manager.h"

namespace orbwatch::app {
namespace {

constexpr int kMessagesInPeriod = 4;

/// Pause between messages; without a watchdog only changes of the state are sent.
hal::Clock::duration pause_of(std::chrono::microseconds period) {
  return period.count() > 0 ? period / kMessagesInPeriod : hal::Clock::duration::max();
}

}  // namespace

ProgressNotice::ProgressNotice(std::string remark, std::function<bool()> is_supervised)
    : remark_(std::move(remark)),
      is_supervised_(std::move(is_supervised)),
      pause_(pause_of(watchdog_period())) {}

Result<> ProgressNotice::start() {
  progress_.open();
  thread_.start("watchdog", [this] { send(); });
  return {};
}

void ProgressNotice::stop() {
  progress_.close();
  thread_.stop();
}

void ProgressNotice::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const Progress progress{status.state, status.interface_faults};
  if (last_ == progress && now - sent_ < pause_) return;
  if (is_supervised_ && !is_supervised_()) return;
  last_ = progress;
  sent_ = now;
  progress_.put(progress);
}

std::string ProgressNotice::text(const Progress& progress) const {
  SystemStatus system;
  system.state = progress.state;
  system.interface_faults = progress.interface_faults;
  return condition_of(system).text + (remark_.empty() ? "" : "; " + remark_);
}

void ProgressNotice::send() {
  std::optional<Progress> sent;
  while (const auto progress = progress_.take()) {
    const bool is_changed = sent != *progress;
    if (!sent) {
      notify(ready_message(text(*progress)));
    } else {
      notify("WATCHDOG=1" + (is_changed ? "\nSTATUS=" + text(*progress) : std::string()));
    }
    sent = *progress;
  }
}

}  // namespace orbwatch::app
