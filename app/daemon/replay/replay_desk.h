// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "app/daemon/replay/replay.h"
#include "app/model/sink/recorded_replays.h"
#include "app/ports/recorder/events/signal_steps.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Texts of the appliance's recipes by their numbers.
using RecipeTexts = std::map<std::uint16_t, std::string>;

/// Limits of a replay, so that it takes nothing from the appliance.
struct ReplayLimits {
  std::chrono::nanoseconds time = std::chrono::minutes(10);
  /// Returns the free memory, bytes; 0: unknown, which is not checked. Called once per replay, on
  /// the desk's thread.
  std::function<std::uint64_t()> free_memory = nullptr;
};

/// Replays events on one background thread, beside the frame path: it shares neither workers nor
/// buffers with the pipeline. One runs at a time; the result of the newest is kept.
class ReplayDesk final : public RecordedReplays {
 public:
  /// `recipes` may be chosen. `events` is not null.
  ReplayDesk(std::shared_ptr<RecordedEvents> events, RecipeTexts recipes, ReplayLimits limits = {});
  ~ReplayDesk() override { ReplayDesk::stop(); }

  void start() override;
  void stop() override;
  std::chrono::nanoseconds cpu_time() const override { return thread_.cpu_time(); }

  Result<std::uint64_t> begin(const ReplayRequest& request) override;
  ReplayStatus status() const override;
  Result<std::shared_ptr<const ReplayResult>> result(std::uint64_t number) const override;
  Result<RecordedCourse> course(std::uint64_t number, const std::string& region,
                                const std::string& figure) const override;
  Result<> cancel(std::uint64_t number) override;

 private:
  struct Job {
    std::uint64_t number = 0;
    ReplayRequest request;
    std::filesystem::path recording;
    RecipeChoice choose;
  };
  struct Finished {
    ReplayResult result;
    recorder::SignalSteps steps;
  };

  Result<RecipeChoice> choice_of(std::uint16_t recipe) const;
  Result<> check_memory(const files::Resolved& site) const;
  void run();
  std::optional<Job> take_job();
  Result<std::shared_ptr<Finished>> measure(const Job& job);
  Result<> measure_sets(Replay& replay, Finished& finished);
  /// Error: the replay is cancelled.
  Result<> advance(std::uint64_t done, std::uint64_t of);
  void end(Result<std::shared_ptr<Finished>> finished);
  Result<std::shared_ptr<const Finished>> finished(std::uint64_t number) const;

  const std::shared_ptr<RecordedEvents> events_;
  const RecipeTexts recipes_;
  const ReplayLimits limits_;
  mutable std::mutex mutex_;  ///< guards the members below, but not the thread
  bool is_started_ = false;
  ReplayStatus status_;
  std::optional<Job> job_;  ///< waits for the thread
  bool is_cancelled_ = false;
  std::shared_ptr<const Finished> finished_;  ///< of the newest replay; null: none
  hal::Thread thread_;
};

/// Memory that programs can use without swapping, bytes; 0: unknown. Reentrant.
std::uint64_t free_memory();

}  // namespace orbwatch::app::daemon
