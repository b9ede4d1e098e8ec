#pragma once

#include <array>
#include <atomic>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/model/status.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/second_meter.h"
#include "hal/camera.h"
#include "hal/lines/frame_trigger.h"
#include "hal/sync/frame_sync.h"
#include "hal/thread/priority_mutex.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Bit n: camera n.
using CameraSet = std::bitset<kMaxCameras>;

/// The cameras of a pipeline: joins their frames into frame sets, turns their faults into values
/// and keeps their figures.
/// Thread rule: start, stop, miss and admit on the main thread, next and report on the pipeline's,
/// the rest on any.
class CameraGroup {
 public:
  using Cameras = std::vector<std::unique_ptr<hal::Camera>>;
  using Names = std::vector<std::string>;
  using Formats = std::vector<hal::StreamFormat>;
  using Triggers = std::vector<std::shared_ptr<hal::FrameTrigger>>;

  /// 1..kMaxCameras cameras, configured to `formats` unless they are `absent`. The log says
  /// `names`, without them the cameras' ids. A camera with a trigger delivers only the frames that
  /// belong to one.
  CameraGroup(Cameras cameras, const Names& names, const Formats& formats, const CameraSet& absent,
              const Triggers& triggers, const hal::SyncSettings& sync);

  Result<> start();
  /// No frame set comes after close(), no frame after stop().
  void stop();
  void close() { sync_.close(); }

  /// Waits for the next set; nullopt at `until` or after close().
  std::optional<hal::FrameSet> next(hal::TimePoint until) { return sync_.next(until); }

  std::size_t size() const { return members_.size(); }
  /// How many cameras have a fault.
  std::size_t faulty() const;
  /// How many cameras have no fault but are late: see FrameMatcher.
  std::size_t late() const;
  /// The first camera without a fault that is not late, or the first without a fault when all are:
  /// its frames begin the sets, see FrameMatcher.
  std::size_t pacing_camera() const;

  /// Processor time of all cameras' capture since the start.
  std::chrono::nanoseconds capture_time() const;

  /// An absent camera's fault.
  void miss(std::size_t camera, hal::Fault fault);
  /// Starts an absent camera, configured to `format`, with the controls that were applied last. It
  /// stays absent on error: it refuses one of them.
  Result<> admit(std::size_t camera, const hal::StreamFormat& format);

  /// Sets the controls of a recipe; may wait for the cameras. A refused one does not keep the
  /// others from being set, since the way back must set as many as possible; returns the first
  /// error. An absent camera gets them when it is admitted.
  Result<> apply(std::uint16_t recipe, const std::vector<CameraControl>& controls);

  /// Fills in `status.cameras`; rates and latencies only with `elapsed`, the time since they were
  /// reported last.
  void report(Status& status, std::optional<hal::Clock::duration> elapsed);

 private:
  struct Member {
    std::unique_ptr<hal::Camera> camera;
    std::string name;     ///< for the log
    bool absent = false;  ///< changed on the main thread, under setting_
    hal::StreamFormat format;
    std::shared_ptr<hal::FrameTrigger> trigger;  ///< null: it runs freely
    std::atomic<hal::Fault> fault{hal::Fault::None};
    bool is_otherwise = false;                 ///< than it was set; the camera's thread's
    std::atomic<hal::TimePoint> last_frame{};  ///< arrival
    hal::PriorityMutex metering;               ///< of the camera's thread and the pipeline's
    SecondMeter meter;
  };

  Result<> start(std::size_t index);
  Result<> set(std::size_t index);
  void on_frame(std::size_t index, hal::Frame frame);
  static void watch_controls(Member& member, const hal::FrameMetadata& metadata);
  void on_fault(std::size_t index, const hal::FaultReport& report);

  hal::FrameSync sync_;
  std::mutex setting_;                   ///< held while controls are set
  std::vector<CameraControl> controls_;  ///< applied last; under setting_
  std::vector<Member> members_;
};

}  // namespace orbwatch::app
