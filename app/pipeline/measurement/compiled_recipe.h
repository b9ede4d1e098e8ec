// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/model/status/status.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/views/view_channel.h"
#include "hal/clock.h"
#include "hal/sync/frame_set.h"
#include "proc/image/result.h"
#include "proc/signals/alarm_board.h"
#include "proc/signals/region_meter.h"

namespace orbwatch::app::pipeline {

/// Recipe with everything that its measurement needs. Recipes share nothing but the memory of
/// views, so that no result mixes two. Made before the run; then it allocates nothing.
/// Thread-bound: the pipeline's thread.
class CompiledRecipe {
 public:
  /// Errors: a region that cannot be measured, or that the measured camera does not cover; limits
  /// that contradict each other.
  static Result<std::unique_ptr<CompiledRecipe>> make(RecipePlan plan,
                                                      const signals::RegionScene& scene);

  /// Checks a plan without compiling. Errors: as make().
  static Result<> check(const RecipePlan& plan, const signals::RegionScene& scene);

  const RecipePlan& plan() const { return plan_; }

  /// Resets regions and alarms, because the recipe has just been selected.
  void begin();

  /// Continues the alarms of `other`, compiled from the same files for other formats of cameras.
  void continue_alarms(const CompiledRecipe& other);

  /// The measured views, in the plan's order.
  std::span<ViewChannel> views() { return views_; }

  /// Renders what is measured of a set, in every view; measure() comes before the channels release
  /// the views.
  void render(const hal::FrameSet& set, const FramePyramids& pyramids, ViewBuffers& buffers,
              WorkerPool& workers);

  /// Measures every region in the views that were rendered last, at the exposure of its camera.
  /// Skips a frame that lacks a setting made until `set_since`, and in a triggered set the frame of
  /// another trigger. While a frame is held its measurement is kept.
  void measure(hal::TimePoint set_since = hal::TimePoint::min());
  /// True if the frame of each measured camera that has one was exposed with all settings made
  /// until `set_since`.
  bool is_set(hal::TimePoint set_since) const;
  /// True if the frame of each measured camera that has one was exposed from `moment` on.
  bool is_exposed_since(hal::TimePoint moment) const;
  /// Leaves the regions without a measurement whose frame was exposed before `moment`.
  void skip_exposed_before(hal::TimePoint moment);
  /// Leaves every region without a measurement.
  void skip();

  std::span<const RegionStatus> regions() const { return {regions_.data(), plan_.regions.size()}; }
  /// True if some region has a hot spot. Nullopt: none is detected, but a region is not measured.
  std::optional<bool> has_hot_spot() const;

  /// Steps the alarms with the newest measurement. The events stay valid until the next call.
  std::span<const signals::AlarmEvent> watch(hal::TimePoint now, bool process_active,
                                             const signals::AlarmSet& acknowledged);
  /// State of the alarms since the last watch().
  std::span<const AlarmStatus> alarms() const { return {alarms_.data(), board_.size()}; }

 private:
  /// Newest picture of a view's measured camera.
  struct MeasuredFrame {
    const View* view = nullptr;  ///< null: the set has no frame of the camera, or of its trigger
    hal::TimePoint exposed{};    ///< start of the exposure
    hal::TimePoint controls_as_of{};  ///< copied from the frame's metadata
    bool held = false;                ///< it was in an earlier set, too
  };
  struct Region {
    signals::RegionMeter meter;
    std::size_t view;
    Quality quality;  ///< quality of a measurement of this frame
  };

  explicit CompiledRecipe(RecipePlan plan) : plan_(std::move(plan)) {}

  RecipePlan plan_;
  std::vector<ViewChannel> views_;
  std::vector<MeasuredFrame> frames_;  ///< one per view
  std::vector<Region> meters_;         ///< one per region
  std::array<RegionStatus, signals::kMaxRegions> regions_;
  std::array<signals::Signals, signals::kMaxRegions>
      signals_;                      ///< signals of regions_, for the board
  signals::RegionSet stale_;         ///< regions without a new measurement since watch()
  signals::AlarmBoard fresh_board_;  ///< initial state that begin() restores
  signals::AlarmBoard board_;
  std::array<AlarmStatus, signals::kMaxAlarms> alarms_;
};

}  // namespace orbwatch::app::pipeline
