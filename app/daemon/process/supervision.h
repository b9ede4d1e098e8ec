// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>

#include "app/daemon/process/appliance_thread.h"
#include "app/daemon/process/restart_watch.h"
#include "app/recent_log.h"
#include "hal/clock.h"
#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Blocks SIGTERM, SIGINT and SIGHUP for this thread and those that it starts, so that a
/// Supervision receives them. On the main thread, before others start.
sigset_t block_signals();

/// Receives the signals and ends trials while the appliance runs on other threads. The thread that
/// calls it opens no device, reads no file and waits neither for a driver nor for the log; only
/// while it turns is the watchdog fed. Thread-bound.
class Supervision {
 public:
  /// StopLine and PowerOff: a line asked for it. RestartDevice: an installed update is to be tried.
  enum class End { Stop, Restart, StopLine, PowerOff, RestartDevice };

  /// Time for the appliance's orderly end; with kLongestAbandonment less than TimeoutStopSec.
  static constexpr std::chrono::seconds kLongestEnd{3};
  /// The same when the computer ends, too: events are written to their end, and a supply that
  /// asks for it lasts for longer.
  static constexpr std::chrono::seconds kLongestEndByLine{15};
  /// Time for each step in place of an orderly end.
  static constexpr std::chrono::seconds kLongestAbandonment{1};

  /// `signals` are blocked; `file` is the configuration file.
  Supervision(const sigset_t& signals, const std::filesystem::path& file,
              std::shared_ptr<const RecentLog> log);

  /// Runs the appliance until a signal, a decision to start again, or its end because it cannot
  /// start. Error: too many open files.
  Result<End> run();

  /// Ends it. False: something hangs; the outputs were set inactive as far as they can be, and the
  /// process must be replaced or ended by _exit() without destroying this object.
  bool finish(End end);

  /// Why the appliance could not start. After run().
  const Result<>& result() const { return appliance_.result(); }

 private:
  void stop_by_line(const std::string& line, bool power_off);
  void restart_device();
  bool is_supervised() const;
  bool is_trial_over() const;
  int signal_that_ends();

  const std::chrono::nanoseconds watchdog_;  ///< its period; 0: there is none
  const hal::FileDescriptor signals_;
  const hal::EventFd woken_;  ///< by the other threads
  std::atomic<hal::TimePoint> turned_;
  std::atomic<bool> is_restart_decided_{false};
  std::atomic<End> device_end_{End::Stop};  ///< Stop: no line has asked
  RestartWatch restarts_;
  ApplianceThread appliance_;
};

}  // namespace orbwatch::app::daemon
