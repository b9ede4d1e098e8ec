// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>

#include "app/daemon/appliance.h"
#include "app/daemon/process/completion.h"
#include "app/daemon/process/restart_watch.h"
#include "app/ports/lines/lines.h"
#include "app/recent_log.h"
#include "hal/clock.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Everything from the choice of the configuration to the appliance's end, on a thread of its own:
/// it opens cameras and interfaces and may wait for drivers, the disk and the service manager. The
/// owner waits for none of them, at its end neither. Thread rule: one owner, apart from
/// report_refusal.
class ApplianceThread {
 public:
  struct Context {
    std::filesystem::path file;  ///< of the configuration
    std::shared_ptr<const RecentLog> log;
    RestartWatch& restarts;                ///< outlives it
    std::function<bool()> is_supervised;   ///< as of ProgressNotice
    std::function<void()> on_end;          ///< called once, on the thread: it has ended
    OnStopLine on_stop_line;               ///< called on the thread of the lines
    std::function<void()> restart_device;  ///< restarts the computer; on any thread
  };

  explicit ApplianceThread(Context context);

  void start();

  /// True: it has ended, by itself when it could not start.
  bool has_ended() const { return ended_.is_set(); }
  /// Why it could not start. Once it has ended.
  const Result<>& result() const { return result_; }

  /// The files are wrong, and something else goes on running. On any thread.
  void report_refusal();

  /// Asks for an orderly end, before a restart or not. False: it does not come within `patience`.
  bool end(bool restarts, std::chrono::milliseconds patience);

  /// Replaces an end that does not come: tells the service manager and sets the outputs inactive,
  /// on yet another thread. False: not within `patience`. The process is to be replaced or ended by
  /// _exit() afterwards, this object must not be destroyed.
  bool abandon(bool restarts, std::chrono::milliseconds patience);

 private:
  Result<> run();
  void serve(Appliance& appliance);
  void publish(Appliance* appliance);

  const Context context_;
  std::atomic<bool> is_ending_{false}, restarts_{false};
  mutable std::mutex mutex_;        ///< of what follows, held only while it is copied
  Appliance* appliance_ = nullptr;  ///< null: not yet, or its end has begun
  std::weak_ptr<Lines> lines_;
  Result<> result_;  ///< the thread's until it has ended
  Completion ended_;
  hal::Thread thread_;
};

}  // namespace orbwatch::app::daemon
