// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/process/restart_watch.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/files/resolve.h"
#include "app/files/runtime/trial.h"
#include "app/log.h"

namespace orbwatch::app::daemon {
namespace {

/// Pause between two looks of a service for the request of a trial, which comes as a file.
constexpr std::chrono::seconds kTrialPause{1};

}  // namespace

RestartWatch::RestartWatch(std::filesystem::path file, Events events)
    : file_(std::move(file)), events_(std::move(events)) {}

void RestartWatch::start() {
  thread_.start("restarts", [this] {
    watch();
    ended_.set();
  });
}

bool RestartWatch::end(std::chrono::milliseconds patience) {
  is_decided_ = true;
  thread_.wake();
  return ended_.wait_for(patience);
}

void RestartWatch::begin(const Chosen& chosen) {
  checksum_ = chosen.site.checksum;
  if (chosen.trial) {
    trial_seconds_ = chosen.trial->seconds;
    trial_end_ = hal::Clock::now() + kLongestStart;
  }
  has_begun_ = true;
}

void RestartWatch::begin_run() {
  if (trial_end_.load() != hal::TimePoint::max()) {
    trial_end_ = hal::Clock::now() + std::chrono::seconds(trial_seconds_);
  }
  runs_ = true;
  thread_.wake();
}

void RestartWatch::ask() {
  is_asked_ = true;
  thread_.wake();
}

Result<> RestartWatch::check() const {
  auto checked = check_restart(file_);
  if (checked) return checked;
  log_line(LogLevel::Error, "does not restart: " + checked.error().message);
  events_.on_refusal();
  return checked;
}

void RestartWatch::restart() {
  if (is_decided_.exchange(true)) return;
  log_soon(LogLevel::Info, {"restarts with its files read again"});
  events_.on_restart();
}

void RestartWatch::watch() {
  const auto next = [this] {
    const hal::TimePoint end = trial_end_;
    return folder_ ? std::min(end, hal::Clock::now() + kTrialPause) : hal::TimePoint::max();
  };
  while (thread_.wait_until(next()) && !is_decided_) {
    if (has_begun_ && asks_for_restart() && !is_decided_.exchange(true)) {
      log_soon(LogLevel::Info, {"restarts for another configuration"});
      events_.on_restart();
    }
    if (runs_ && is_asked_.exchange(false) && check()) restart();
  }
}

/// A trial is requested, or the one that runs has ended: by its time, or cancelled. A confirmed one
/// goes on, it is what the files say.
bool RestartWatch::asks_for_restart() {
  if (!folder_) return false;
  if (is_trial_for(*folder_, file_)) return true;
  if (trial_end_.load() == hal::TimePoint::max()) return false;
  const auto running = files::running_trial(*folder_);
  if (running && !*running) {
    const auto confirmed = files::confirmed_trial(*folder_);
    if (confirmed && *confirmed) return false;  // its files are being written
    trial_end_ = hal::TimePoint::max();
    const auto files = files::resolve(file_);
    return !files || files->checksum != checksum_;
  }
  return hal::Clock::now() >= trial_end_.load();
}

}  // namespace orbwatch::app::daemon
