// SPDX-License-Identifier: Apache-2.0
#include "app/service/progress_notice.h"

#include <algorithm>
#include <utility>

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
  if (state_ == status.state && now - sent_ < pause_) return;
  if (is_supervised_ && !is_supervised_()) return;
  state_ = status.state;
  sent_ = now;
  progress_.put(status.state);
}

std::string ProgressNotice::text(SystemState state) const {
  return std::string(operator_text(state)) + (remark_.empty() ? "" : "; " + remark_);
}

void ProgressNotice::send() {
  std::optional<SystemState> sent;
  while (const auto state = progress_.take()) {
    const bool is_changed = sent != *state;
    if (!sent) {
      notify(ready_message(text(*state)));
    } else {
      notify("WATCHDOG=1" + (is_changed ? "\nSTATUS=" + text(*state) : std::string()));
    }
    sent = *state;
  }
}

}  // namespace orbwatch::app
