#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/model/status.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/views/view_channel.h"
#include "hal/clock.h"
#include "hal/sync/frame_set.h"
#include "proc/image/result.h"
#include "proc/signals/alarm_board.h"
#include "proc/signals/region_meter.h"

namespace orbwatch::app {

/// A recipe with everything that its measurement needs. Recipes share nothing but the memory of
/// views, so that no result mixes two. Made before the run; then it allocates nothing.
/// Thread-bound: the pipeline's thread.
class CompiledRecipe {
 public:
  /// Errors: a region that cannot be measured, or that the measured camera does not see; limits
  /// that contradict each other.
  static Result<std::unique_ptr<CompiledRecipe>> make(RecipePlan plan,
                                                      const signals::RegionScene& scene);

  /// Errors: as make(). Compiles nothing.
  static Result<> check(const RecipePlan& plan, const signals::RegionScene& scene);

  const RecipePlan& plan() const { return plan_; }

  /// Resets regions and alarms: the recipe has just been selected.
  void begin();

  /// The measured views, in the plan's order.
  std::span<ViewChannel> views() { return views_; }

  /// Renders every view of a set, to be measured before they are taken from the channels.
  void render(const hal::FrameSet& set, const FramePyramids& pyramids, ViewBuffers& buffers,
              WorkerPool& workers);

  /// Measures every region in the views that were rendered last, at the exposure of its camera.
  /// Not measured is a frame without all that was set until `set_since`, and in a triggered set the
  /// frame of another trigger. While a frame is held its measurement is kept.
  void measure(hal::TimePoint set_since = hal::TimePoint::min());
  /// Whether each camera that is measured and has a frame has in it all that was set until then.
  bool is_set(hal::TimePoint set_since) const;
  /// Leaves every region without a measurement.
  void skip();

  std::span<const RegionStatus> regions() const { return {regions_.data(), plan_.regions.size()}; }
  /// Whether some region has a hot spot. Nullopt: none is seen, but a region is not measured.
  std::optional<bool> has_hot_spot() const;

  /// Steps the alarms with the newest measurement. The events stay valid until the next call.
  std::span<const signals::AlarmEvent> watch(hal::TimePoint now, bool process_active,
                                             const signals::AlarmSet& acknowledged);
  /// As they are since watch().
  std::span<const AlarmStatus> alarms() const { return {alarms_.data(), board_.size()}; }

 private:
  /// The newest picture of a view's measured camera.
  struct MeasuredFrame {
    const View* view = nullptr;  ///< null: the set has no frame of the camera, or of its trigger
    hal::TimePoint exposed{};    ///< start of its exposure
    hal::TimePoint controls_as_of{};  ///< of its metadata
    bool held = false;                ///< it was in an earlier set, too
  };
  struct Region {
    signals::RegionMeter meter;
    std::size_t view;
    Quality quality;  ///< when it is measured
  };

  explicit CompiledRecipe(RecipePlan plan) : plan_(std::move(plan)) {}

  RecipePlan plan_;
  std::vector<ViewChannel> views_;
  std::vector<MeasuredFrame> frames_;  ///< by view
  std::vector<Region> meters_;         ///< by region
  std::array<RegionStatus, signals::kMaxRegions> regions_;
  std::array<signals::Signals, signals::kMaxRegions> signals_;  ///< of regions_, for the board
  signals::RegionSet stale_;         ///< regions without a new measurement since watch()
  signals::AlarmBoard fresh_board_;  ///< as begin() starts it
  signals::AlarmBoard board_;
  std::array<AlarmStatus, signals::kMaxAlarms> alarms_;
};

}  // namespace orbwatch::app
