#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "hal/clock.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Selects recipes while frames run: sets the cameras on a thread of its own, off the frame path,
/// and says for each frame set to which recipe it belongs by the moment of its exposure. What is
/// exposed after a request never belongs to a recipe before it. One request waits; the newest wins.
/// Thread rule: request and has_failed on any thread, of on the pipeline's, stop on the main.
class RecipeSwitch {
 public:
  /// Sets the cameras to what a recipe asks for; may wait for them.
  using Apply = std::function<Result<>(std::size_t recipe)>;

  /// What a frame set belongs to.
  struct Selection {
    std::size_t recipe = 0;
    /// Cameras are set to it for exposures that begin here or later; the earliest moment there is
    /// when nothing was set since the start.
    hal::TimePoint set_since = hal::TimePoint::min();
    std::uint64_t changes = 0;  ///< how often cameras were set since the start

    bool operator==(const Selection&) const = default;
  };

  /// `first` is measured from the start; its settings are applied already. Starts the thread.
  /// Without `apply` no recipe sets a camera, and each one counts from its request on.
  RecipeSwitch(std::size_t first, Apply apply);
  ~RecipeSwitch();
  RecipeSwitch(const RecipeSwitch&) = delete;
  RecipeSwitch& operator=(const RecipeSwitch&) = delete;

  /// Asks for a recipe; does not wait for the cameras.
  void request(std::size_t recipe);

  /// What a set belongs to whose exposure began at `stamp`; nothing for one that began after a
  /// request, while the cameras were not set to it yet, or before a recipe that was told already.
  std::optional<Selection> of(hal::TimePoint stamp);

  /// The cameras refused the last request's settings; the recipe before stays, with its own.
  bool has_failed() const;

  /// Ends the thread, after the request under way; repeating it does nothing.
  void stop();

 private:
  struct Due {
    Selection selection;
    hal::TimePoint from;
  };

  void run(std::size_t set_to);
  std::size_t change(std::unique_lock<std::mutex>& lock, std::size_t set_to);

  const Apply apply_;
  mutable std::mutex mutex_;  ///< never held while cameras are set
  std::condition_variable work_;
  std::optional<std::size_t> requested_;
  Selection current_;  ///< told last
  hal::TimePoint current_from_ = hal::TimePoint::min();
  std::optional<hal::TimePoint> changing_;  ///< what is exposed since is not `current_`'s any more
  std::optional<Due> due_;                  ///< what follows it, once that is known
  std::uint64_t changes_ = 0;
  bool failed_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace orbwatch::app
