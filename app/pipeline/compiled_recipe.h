#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/pipeline/recipe_plan.h"
#include "app/pipeline/status.h"
#include "app/pipeline/view.h"
#include "app/pipeline/worker_pool.h"
#include "hal/buffer_pool.h"
#include "hal/frame_set.h"
#include "proc/image/result.h"
#include "proc/signals/alarm_board.h"
#include "proc/signals/region_meter.h"

namespace orbwatch::app {

/// A recipe with everything that measuring by it needs: nothing of it is shared with another one,
/// so that no result mixes two. Made before the run; then it allocates nothing. Thread-bound: the
/// pipeline's thread.
class CompiledRecipe {
 public:
  /// Errors: a region that cannot be measured, or that the measured camera does not see; limits
  /// that contradict each other.
  static Result<std::unique_ptr<CompiledRecipe>> make(RecipePlan plan,
                                                      const signals::RegionScene& scene);

  const RecipePlan& plan() const { return plan_; }

  /// Forgets what was measured before: it has just been selected.
  void begin();

  /// Renders view `n` from a set. Returns its buffer, or null when the sinks hold every one; it can
  /// be measured all the same.
  std::shared_ptr<View> render(std::size_t n, const hal::FrameSet& set, WorkerPool& workers);

  /// Measures every region in the views that were rendered last, at the moment of its camera's
  /// exposure. Not measured is a frame whose exposure began before `set_since`, with other
  /// settings, and in a triggered set the frame of another trigger. What was measured in a frame
  /// stays as it is while that frame is held.
  void measure(hal::TimePoint set_since = hal::TimePoint::min());
  /// There is nothing to measure in.
  void skip();

  std::span<const RegionStatus> regions() const { return {regions_.data(), plan_.regions.size()}; }
  /// Some region has a hot spot.
  bool has_hot_spot() const;

  /// Steps the alarms with what was measured last; what happened stays readable until the next
  /// call.
  std::span<const signals::AlarmEvent> watch(hal::TimePoint now, bool process_active,
                                             const signals::AlarmSet& acknowledged);
  /// As they are since watch().
  std::span<const AlarmStatus> alarms() const { return {alarms_.data(), board_.size()}; }

 private:
  struct Output {
    std::unique_ptr<ViewRenderer> renderer;
    hal::BufferPool<View> pool;
    View unshared;                   ///< to measure in when sinks hold every buffer
    const View* rendered = nullptr;  ///< last; null: the measured camera had no frame of the set
    hal::TimePoint exposed{};        ///< when that one's exposure began
    bool held = false;               ///< it was in an earlier set, too
  };
  struct Region {
    signals::RegionMeter meter;
    std::size_t view;
    Quality quality;  ///< when it is measured
  };

  explicit CompiledRecipe(RecipePlan plan) : plan_(std::move(plan)) {}

  RecipePlan plan_;
  std::vector<Output> outputs_;  ///< by view
  std::vector<Region> meters_;   ///< by region
  std::array<RegionStatus, signals::kMaxRegions> regions_;
  std::array<signals::Signals, signals::kMaxRegions> signals_;  ///< of regions_, for the board
  signals::RegionSet stale_;         ///< regions without a new measurement since watch()
  signals::AlarmBoard fresh_board_;  ///< to begin with
  signals::AlarmBoard board_;
  std::array<AlarmStatus, signals::kMaxAlarms> alarms_;
};

}  // namespace orbwatch::app
