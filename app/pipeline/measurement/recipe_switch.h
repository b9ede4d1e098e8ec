// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "hal/clock.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::app::pipeline {

/// Selects recipes while frames run: sets the cameras on a thread of its own, off the frame path,
/// and assigns each frame set to a recipe by its exposure. A set exposed after a request never
/// belongs to an earlier recipe. Queue: one request; the newest wins.
/// Thread rule: request, refusal and has_failed on any thread, selection_at on the pipeline's,
/// start and stop on the main.
class RecipeSwitch {
 public:
  /// Sets the cameras' controls for a recipe; may wait for them.
  using Apply = std::function<Result<>(std::size_t recipe)>;

  /// Recipe of a frame set.
  struct Selection {
    std::size_t recipe = 0;
    /// Moment at which the cameras were set; the settings take effect later: see
    /// hal::FrameMetadata; min() until they are set for the first time.
    hal::TimePoint set_since = hal::TimePoint::min();
    std::uint64_t changes = 0;  ///< number of times that cameras were set since the start

    bool operator==(const Selection&) const = default;
  };

  /// Refused request: recipes by index.
  struct Refusal {
    std::size_t wanted = 0;
    std::size_t kept = 0;  ///< the previous one, which stays selected

    bool operator==(const Refusal&) const = default;
  };

  /// `first` is selected from the start; its settings are applied already. Without `apply` no
  /// recipe sets a camera, and each one is selected as soon as it is requested.
  RecipeSwitch(std::size_t first, Apply apply);
  ~RecipeSwitch();
  RecipeSwitch(const RecipeSwitch&) = delete;
  RecipeSwitch& operator=(const RecipeSwitch&) = delete;

  /// Starts the thread that sets the cameras, which have been started: from then on they refuse a
  /// control that changes what a count means. Sets those of a request that was made before.
  void start();

  /// Requests a recipe; does not wait for the cameras.
  void request(std::size_t recipe);

  /// Returns the recipe of a set exposed at `stamp`. nullopt: it was exposed after a request whose
  /// settings the cameras do not have yet, or before a selection that was returned already.
  std::optional<Selection> selection_at(hal::TimePoint stamp);

  /// Newest request, if the cameras refused its settings and were set back to the previous
  /// recipe's; nullopt: they took them, or are still being set.
  std::optional<Refusal> refusal() const;
  bool has_failed() const { return refusal().has_value(); }

  /// Ends the thread after the current request; repeating it does nothing.
  void stop();

 private:
  struct Pending {
    Selection selection;
    hal::TimePoint from;
  };

  void run();
  void change(std::size_t wanted);

  const Apply apply_;
  std::size_t set_to_;  ///< recipe that the cameras are set to; used by the thread only
  mutable hal::PriorityMutex mutex_;  ///< never held while cameras are set
  std::optional<std::size_t> requested_;
  Selection current_;  ///< selection that was returned last
  hal::TimePoint current_from_ = hal::TimePoint::min();
  std::optional<hal::TimePoint>
      changing_;                    ///< sets exposed from here on do not belong to `current_`
  std::optional<Pending> pending_;  ///< next selection, once it is known
  std::uint64_t changes_ = 0;
  std::optional<Refusal> refusal_;
  hal::Thread thread_;
};

}  // namespace orbwatch::app::pipeline
