#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/pipeline/compiled_recipe.h"
#include "app/pipeline/display_throttle.h"
#include "app/pipeline/measurement.h"
#include "app/pipeline/pan_tilt_zoom.h"
#include "app/pipeline/second_meter.h"
#include "app/pipeline/sink.h"
#include "app/pipeline/status.h"
#include "app/pipeline/view.h"
#include "app/pipeline/view_renderer.h"
#include "app/pipeline/worker_pool.h"
#include "hal/buffer_pool.h"
#include "hal/camera.h"
#include "hal/frame_sync.h"
#include "hal/lines/frame_trigger.h"
#include "hal/lines/process_input.h"

namespace orbwatch::app {

/// Everything the pipeline needs; cameras are configured already.
struct PipelinePlan {
  std::vector<std::unique_ptr<hal::Camera>> cameras;  ///< 1..kMaxCameras; the first one paces
  std::vector<hal::StreamFormat> formats;             ///< by camera
  std::vector<std::shared_ptr<hal::FrameTrigger>>
      triggers;  ///< by camera; null or none: runs freely
  std::vector<std::shared_ptr<const hal::ProcessInput>> process_inputs;  ///< at most 32
  std::vector<ViewPlan> views;  ///< to look at, by index; those of the recipes come after them
  std::vector<std::unique_ptr<CompiledRecipe>> recipes;  ///< at most kMaxRecipes
  std::size_t view_count = 0;                            ///< those of the recipes included
  std::uint32_t configuration_checksum = 0;
  /// The newest figures, without waiting; null: none are known.
  std::function<Health(hal::TimePoint now)> health;
  hal::Clock::duration deadline{0};  ///< of a frame set; 0: the pacing camera's frame period
  hal::SyncSettings sync;
  std::size_t workers = 1;  ///< threads besides the pipeline's own
};

/// Frames in, views and status out, on one thread and its workers. Nothing here waits for a sink.
/// Thread rule: start and stop on the main thread, command and point on any.
class Pipeline {
 public:
  explicit Pipeline(PipelinePlan plan);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// Sinks are the caller's, started, and outlive the run.
  Result<> start(std::vector<Sink*> sinks);
  void stop();

  /// Those of the recipes included.
  std::size_t view_count() const { return plan_.view_count; }

  /// Whose frames the sets begin with: the first one without a fault. On any thread.
  std::size_t pacing_camera() const;

  /// Points a view that is only looked at elsewhere: see PanTiltZoom::point().
  Result<std::uint64_t> point(std::size_t view, const Pointing& pointing) {
    return pan_tilt_zoom_.point(view, pointing);
  }

  /// All that concerns views and measuring; takes effect between two frame sets.
  CommandResult command(const Command& command);

 private:
  /// Fed by the camera's thread, read once a second by the pipeline's.
  struct CameraMeter {
    std::mutex mutex;
    SecondMeter meter;
  };

  /// What a recipe sets cameras to.
  struct RecipeControls {
    std::uint16_t number = 0;
    std::vector<CameraControl> controls;
  };

  void on_frame(std::size_t camera, hal::Frame frame);
  void on_fault(std::size_t camera, const hal::FaultReport& report);
  void run();
  void process(const hal::FrameSet& set);
  void show(std::size_t index, const hal::FrameSet& set);
  void publish(std::size_t index, const std::shared_ptr<View>& view);
  void start_measuring();
  Result<> set_cameras(const RecipeControls& recipe);
  CommandResult aim(const Command& command);
  void note(const AlarmNotice& notice);
  void count_cameras();
  void note_timing(hal::Clock::duration took);
  void publish_status();
  void roll_figures(hal::TimePoint now);
  std::uint32_t process_inputs() const;
  hal::Clock::duration deadline() const;
  SystemState state() const;

  PipelinePlan plan_;
  hal::FrameSync sync_;
  WorkerPool workers_;
  PanTiltZoom pan_tilt_zoom_;
  std::vector<PointedRenderer> renderers_;    ///< by view to look at
  std::vector<hal::BufferPool<View>> pools_;  ///< by view to look at
  std::optional<Measurement> measurement_;    ///< if there are recipes
  DisplayThrottle throttle_;
  std::vector<SecondMeter> view_meters_;
  std::array<std::atomic<hal::Fault>, kMaxCameras> faults_;
  std::array<CameraMeter, kMaxCameras> camera_meters_;
  std::array<std::atomic<hal::TimePoint>, kMaxCameras> last_frames_;  ///< arrival
  std::atomic<std::size_t> selected_view_{0};
  std::atomic<bool> stopping_{false};
  Status status_;
  double load_of_second_ = 0;
  hal::Clock::duration skew_of_second_{0};
  hal::TimePoint last_roll_;
  std::vector<Sink*> sinks_;
  std::thread thread_;
};

}  // namespace orbwatch::app
