// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/sink/sink.h"
#include "app/model/sink/view.h"
#include "app/model/status/status.h"
#include "app/pipeline/camera_group.h"
#include "app/pipeline/frame_budget.h"
#include "app/pipeline/measurement/compiled_recipe.h"
#include "app/pipeline/measurement/measurement.h"
#include "app/pipeline/pipeline_settings.h"
#include "app/pipeline/recompiled.h"
#include "app/pipeline/second_meter.h"
#include "app/pipeline/stage_meter.h"
#include "app/pipeline/views/exposure_match.h"
#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/pan_tilt_zoom.h"
#include "app/pipeline/views/view_buffers.h"
#include "app/pipeline/views/view_channel.h"
#include "app/pipeline/views/view_colours.h"
#include "app/pipeline/worker_pool.h"
#include "hal/camera.h"
#include "hal/lines/frame_trigger.h"
#include "hal/lines/process_input.h"
#include "hal/sync/frame_sync.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/shared_threads.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::pipeline {

/// State from outside the pipeline that it reports.
struct Surroundings {
  Health health;
  std::uint32_t line_faults = 0;       ///< see SystemStatus
  std::uint32_t interface_faults = 0;  ///< see SystemStatus
  bool realtime = false;               ///< see SystemStatus
  bool memory_locked = false;          ///< see SystemStatus
  std::array<CameraWatchStatus, kMaxCameras> watched{};
  bool configuration_refused = false;  ///< see SystemStatus
  std::uint32_t trial_left = 0;        ///< see SystemStatus
};

/// Everything that the pipeline needs; cameras are configured already, unless they are absent.
struct PipelinePlan : PipelineSettings {
  std::vector<std::unique_ptr<hal::Camera>> cameras;  ///< 1..kMaxCameras; the first one paces
  std::vector<std::string> camera_names;   ///< names in the site's files; none: their ids
  std::vector<hal::StreamFormat> formats;  ///< format of each camera; assumed for an absent one
  CameraSet absent;                        ///< cameras to be admitted when they connect
  std::vector<std::shared_ptr<hal::FrameTrigger>>
      triggers;  ///< trigger of each camera; null or none: runs freely
  /// At most kMaxProcessInputs.
  std::vector<std::shared_ptr<const hal::ProcessInput>> process_inputs;
  std::vector<ViewPlan> views;  ///< display views, by index; those of the recipes come after them
  std::vector<std::unique_ptr<CompiledRecipe>> recipes;  ///< at most kMaxRecipes
  std::vector<remap::ColourMap::Table> colour_maps;      ///< tables by SourceColours::map, all maps
  std::size_t view_count = 0;  ///< number of views, including those of the recipes
  std::uint32_t configuration_checksum = 0;
  /// Threads for work off the frame path, which may be slow.
  std::shared_ptr<hal::SharedThreads> background = hal::SharedThreads::alone();
  std::size_t reserved_cores = 0;  ///< cores for the frame path alone; 0: it shares all
  /// Returns what the machine says at the exposure of a set; without a set, what it says still at
  /// `now`. Does not wait. Null: it says nothing.
  std::function<const MachineStatus&(hal::TimePoint now, const hal::FrameSet* set)> machine;
  /// Returns the newest figures without waiting; null: none are known.
  std::function<Surroundings(hal::TimePoint now)> surroundings;
};

/// Makes views and status from frames, on one thread and its workers; see process(). Nothing here
/// waits for a sink.
/// Thread rule: start and stop on the main thread, all else on any.
class Pipeline {
 public:
  explicit Pipeline(PipelinePlan plan);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// The sinks belong to the caller, are started, and outlive the run. The cameras are set to a
  /// recipe that was selected before once they have been started.
  Result<> start(std::vector<Sink*> sinks);
  void stop();

  /// Formats for which the views are compiled, by camera. On the main thread.
  const std::vector<hal::StreamFormat>& formats() const { return formats_; }
  /// Exchanges the objects made for a camera between two frame sets. Returns once they are in use,
  /// at the latest after a heartbeat. On the main thread, while the pipeline runs.
  Result<> take_over(Recompiled recompiled);
  /// Starts an absent camera that was configured to `format`: see CameraGroup::admit(). On the
  /// main thread.
  Result<> admit(std::size_t camera, const hal::StreamFormat& format) {
    return cameras_.admit(camera, format);
  }
  /// Sets the fault of an absent camera. On the main thread.
  void miss(std::size_t camera, hal::Fault fault) { cameras_.miss(camera, fault); }

  /// Number of views, including those of the recipes.
  std::size_t view_count() const { return plan_.view_count; }

  /// The first camera without a fault: its frames begin the sets.
  std::size_t pacing_camera() const { return cameras_.pacing_camera(); }

  /// Points a display view in another direction: see PanTiltZoom::point().
  Result<std::uint64_t> point(std::size_t view, const Pointing& pointing) {
    return pan_tilt_zoom_.point(view, pointing);
  }

  // Commands: each returns at once and takes effect between two frame sets. Those that concern
  // measurement are NotPossible without a recipe; see Measurement.

  /// Publishes this view as the selected one. ArgumentOutOfRange: no such view.
  CommandResult select_view(std::size_t view);
  /// Turns a display view: see PanTiltZoom::turn(). ArgumentOutOfRange: no such view, or arguments
  /// that turn() refuses; NotPossible: the view is a recipe's.
  CommandResult point_view(std::size_t view, double yaw, double pitch, double h_fov);
  /// Changes a source's weight in a display view: see PanTiltZoom::mix(). Results as point_view().
  CommandResult mix_sources(std::size_t view, std::size_t source, double weight);
  /// Show a source of any view in other colours, or over other values: see ViewColours.
  CommandResult set_colour_map(std::size_t view, std::size_t source, std::size_t map) {
    return colours_.set_map(view, source, map);
  }
  CommandResult set_colour_range(std::size_t view, std::size_t source,
                                 const std::array<double, 2>& range) {
    return colours_.set_range(view, source, range);
  }
  CommandResult start_measuring();
  CommandResult stop_measuring();
  CommandResult select_recipe(std::size_t number);
  CommandResult trigger();
  CommandResult acknowledge_alarm(std::size_t number, const Giver& by = {});
  CommandResult set_process_active(bool active);

  /// Selection of a recipe that a camera refused: see Measurement::refusal(). nullopt without a
  /// recipe.
  std::optional<RecipeSwitch::Refusal> recipe_refusal() const {
    return measurement_ ? measurement_->refusal() : std::nullopt;
  }

 private:
  /// Exchange that take_over() waits for.
  struct Exchange {
    FramePyramids pyramids;
    std::unique_ptr<ExposureMatch> exposures;
    Recompiled recompiled;
    bool is_in_use = false;
  };

  void make_measurement();
  void exchange();
  void end_exchange();
  CommandResult check_display_view(std::size_t view) const;
  void run();
  void process(const hal::FrameSet& set);
  void apply_commands(const hal::FrameSet& set);
  void measure(const hal::FrameSet& set);
  void show(const hal::FrameSet& set);
  void show_displays(const hal::FrameSet& set, bool are_due);
  void keep_heartbeat();
  std::span<ViewChannel> measured();
  void idle();
  void match_exposures(const hal::FrameSet& set);
  void exchange_colours(std::span<ViewChannel> views);
  void ask_readers(std::span<ViewChannel> views, hal::TimePoint stamp);
  void publish(ViewChannel& channel);
  void begin_status(const hal::FrameSet& set);
  void end_set(hal::Clock::duration spent);
  void publish_status();
  void roll_rates(hal::Clock::duration elapsed);
  void follow_pace();
  void report_live_views();
  void report_process_inputs();
  SystemState state() const;

  PipelinePlan plan_;
  std::vector<hal::StreamFormat> formats_;  ///< copy for the main thread
  std::vector<ViewPlan> views_;             ///< all views, by index; used by the main thread only
  hal::PriorityMutex exchanging_;
  std::condition_variable_any exchanged_;
  Exchange* exchange_ = nullptr;  ///< pending or in use; guarded by exchanging_
  CameraGroup cameras_;
  WorkerPool workers_;
  const PictureUses sharpenings_;  ///< sharpenings that any view may request; no areas
  FramePyramids pyramids_;
  std::unique_ptr<ExposureMatch> exposures_;
  std::vector<ViewChannel> displays_;
  std::size_t first_display_ = 0;           ///< display view whose turn is next
  std::optional<ViewBuffers> buffers_;      ///< set by start()
  std::optional<Measurement> measurement_;  ///< set if there are recipes
  PanTiltZoom pan_tilt_zoom_;
  ViewColours colours_;
  FrameBudget budget_;
  StageMeter stages_;
  std::vector<SecondMeter>
      view_meters_;  ///< one per view, by index; recipes may share a view's name
  std::atomic<std::size_t> selected_view_{0};
  Status status_;
  hal::Clock::duration largest_skew_{0};  ///< largest skew since last_roll_
  hal::TimePoint last_roll_;
  hal::TimePoint last_status_;  ///< time of the newest status
  std::vector<Sink*> sinks_;
  hal::Thread thread_;
};

}  // namespace orbwatch::app::pipeline
