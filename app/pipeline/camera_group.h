// SPDX-License-Identifier: Apache-2.0
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

#include "app/model/status/status.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/second_meter.h"
#include "hal/camera.h"
#include "hal/lines/frame_trigger.h"
#include "hal/sync/frame_sync.h"
#include "hal/thread/priority_mutex.h"
#include "proc/image/result.h"

namespace orbwatch::app::pipeline {

/// Set of cameras; bit n: camera n.
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

  /// Takes 1..kMaxCameras cameras, configured to `formats` unless they are `absent`. The log uses
  /// `names`, or without them the cameras' ids. A camera with a trigger delivers only the frames
  /// that belong to one.
  CameraGroup(Cameras cameras, const Names& names, const Formats& formats, const CameraSet& absent,
              const Triggers& triggers, const hal::SyncSettings& sync);

  Result<> start();
  /// Stops the cameras. There is no frame set after close(), and no frame after stop().
  void stop();
  void close() { sync_.close(); }

  /// Waits for the next set; nullopt at `until` or after close().
  std::optional<hal::FrameSet> next(hal::TimePoint until) { return sync_.next(until); }
  /// True if the next set has arrived.
  bool has_next() const { return sync_.has_set(); }

  std::size_t size() const { return members_.size(); }
  /// Number of cameras with a fault.
  std::size_t faulty() const;
  /// Number of cameras without a fault that are late: see FrameMatcher.
  std::size_t late() const;
  /// The first camera without a fault that is not late, or the first without a fault when all are
  /// late: its frames begin the sets, see FrameMatcher.
  std::size_t pacing_camera() const;

  /// Processor time of all cameras' capture since the start.
  std::chrono::nanoseconds capture_time() const;

  /// Sets the fault of an absent camera.
  void miss(std::size_t camera, hal::Fault fault);
  /// Starts an absent camera, configured to `format`, with the controls that were applied last. It
  /// stays absent on error: it refuses one of them, or they change what a count means.
  Result<> admit(std::size_t camera, const hal::StreamFormat& format);

  /// Sets the controls of a recipe; may wait for the cameras. After a refusal the others are still
  /// set, since a return to the previous recipe must set as many as possible; returns the first
  /// error. An absent camera gets them when it is admitted, an unplugged one when it reconnects.
  Result<> apply(std::uint16_t recipe, const std::vector<CameraControl>& controls);

  /// Fills in `status.cameras`; rates and latencies only with `elapsed`, the time since the last
  /// report of them.
  void report(Status& status, std::optional<hal::Clock::duration> elapsed);

 private:
  struct Member {
    std::unique_ptr<hal::Camera> camera;
    std::string name;     ///< name in the log
    bool absent = false;  ///< changed on the main thread, under setting_
    hal::StreamFormat format;
    std::shared_ptr<hal::FrameTrigger> trigger;  ///< null: the camera runs freely
    std::atomic<hal::Fault> fault{hal::Fault::None};
    bool is_otherwise =
        false;  ///< a control differs from its setting; used by the camera's thread only
    std::atomic<hal::TimePoint> last_frame{};  ///< arrival of the last frame
    hal::PriorityMutex
        metering;  ///< guards the figures that the camera's thread shares with the pipeline's
    SecondMeter meter;
  };

  Result<> start(std::size_t index);
  Result<> set(std::size_t index);
  void abandon(std::size_t camera);
  void on_frame(std::size_t index, hal::Frame frame);
  static void watch_controls(Member& member, const hal::FrameMetadata& metadata);
  void on_fault(std::size_t index, const hal::FaultReport& report);

  hal::FrameSync sync_;
  std::mutex setting_;                   ///< held while controls are set
  std::vector<CameraControl> controls_;  ///< controls applied last; guarded by setting_
  std::vector<Member> members_;
};

}  // namespace orbwatch::app::pipeline
