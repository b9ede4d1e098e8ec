#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/pipeline/display_throttle.h"
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
#include "proc/signals/hot_spot.h"
#include "proc/signals/measure.h"

namespace orbwatch::app {

/// What is measured, and where.
struct MeasurementPlan {
  std::size_t view = 0;  ///< index of the view whose measured plane counts
  signals::RadiometricScale scale;
  double threshold = 0;  ///< counts at which a pixel belongs to the hot spot
};

/// Everything the pipeline needs; cameras are configured already.
struct PipelinePlan {
  std::vector<std::unique_ptr<hal::Camera>> cameras;  ///< 1..kMaxCameras; the first one paces
  std::vector<hal::StreamFormat> formats;             ///< by camera
  std::vector<std::shared_ptr<hal::FrameTrigger>>
      triggers;  ///< by camera; null or none: runs freely
  std::vector<std::shared_ptr<const hal::ProcessInput>> process_inputs;  ///< at most 32
  std::vector<ViewPlan> views;                                           ///< 1..kMaxViews, by index
  std::optional<MeasurementPlan> measurement;
  hal::Clock::duration deadline{0};  ///< of a frame set; 0: the pacing camera's frame period
  hal::SyncSettings sync;
  std::size_t workers = 1;       ///< threads besides the pipeline's own
  std::size_t view_buffers = 6;  ///< per view, shared with the sinks
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

  /// Takes effect at the next frame set.
  CommandResult command(const Command& command);

  /// Points a view that is only looked at elsewhere: see PanTiltZoom::point().
  Result<std::uint64_t> point(std::size_t view, const Pointing& pointing) {
    return pan_tilt_zoom_.point(view, pointing);
  }

 private:
  /// Fed by the camera's thread, read once a second by the pipeline's.
  struct CameraMeter {
    std::mutex mutex;
    SecondMeter meter;
  };

  void on_frame(std::size_t camera, hal::Frame frame);
  void on_fault(std::size_t camera, const hal::FaultReport& report);
  void run();
  void process(const hal::FrameSet& set);
  bool is_measured(std::size_t view) const {
    return plan_.measurement && plan_.measurement->view == view;
  }
  void make_view(std::size_t index, const hal::FrameSet& set);
  void measure(const View& view, bool delivered);
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
  std::vector<PointedRenderer> renderers_;    ///< by view
  std::vector<std::size_t> order_;            ///< of rendering: what is measured comes first
  std::vector<hal::BufferPool<View>> pools_;  ///< by view
  std::optional<View> unshared_;              ///< to measure in when sinks hold every buffer
  std::optional<signals::HotSpotDetector> detector_;
  DisplayThrottle throttle_;
  std::vector<SecondMeter> view_meters_;
  std::array<std::atomic<hal::Fault>, kMaxCameras> faults_;
  std::array<CameraMeter, kMaxCameras> camera_meters_;
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
