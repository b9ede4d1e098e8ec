// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "app/daemon/configuration/configuration_choice.h"
#include "app/daemon/process/completion.h"
#include "hal/clock.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Decides when a running daemon starts again with other files: a trial is requested, ends by its
/// time or is cancelled, or somebody asks for it and the files permit it. On a thread of its own,
/// since it reads and checks files. Thread rule: start on the owner's thread, the rest on any.
class RestartWatch {
 public:
  struct Events {
    std::function<void()> on_restart;  ///< decided; called once
    std::function<void()> on_refusal;  ///< asked for in vain, which was logged
  };

  /// `file` is the configuration file. The events are called on any thread and must not wait.
  RestartWatch(std::filesystem::path file, Events events);
  ~RestartWatch() { thread_.stop(); }

  void start();

  /// Notes the configuration that is about to run: from now on requests of trials are looked for,
  /// and a trial ends kLongestStart from now.
  void begin(const Chosen& chosen);
  /// It runs: a trial ends after its time.
  void begin_run();

  /// When the trial goes back; max: none runs.
  hal::TimePoint trial_end() const { return trial_end_; }

  /// Handles SIGHUP: starts again if the files permit it. Returns at once; answered once it runs.
  void ask();
  /// Checks that the files permit it, and waits for that. Error: why not, which was logged.
  Result<> check() const;
  /// Starts again, for files that passed check().
  void restart();

  /// Decides nothing more. False: the check under way does not end within `patience`.
  bool end(std::chrono::milliseconds patience);

  /// TimeoutStartSec of the unit: the compiling of a large site's views.
  static constexpr std::chrono::minutes kLongestStart{3};

 private:
  void watch();
  bool asks_for_restart();

  const std::filesystem::path file_;
  const Events events_;
  const std::optional<std::filesystem::path> folder_ = service_folder();
  std::atomic<bool> has_begun_{false}, runs_{false}, is_asked_{false}, is_decided_{false};
  std::atomic<int> trial_seconds_{0};
  std::atomic<std::uint32_t> checksum_{0};  ///< of what runs
  std::atomic<hal::TimePoint> trial_end_{hal::TimePoint::max()};
  Completion ended_;
  hal::Thread thread_;
};

}  // namespace orbwatch::app::daemon
