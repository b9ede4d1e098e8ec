// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/simulation/machine.h"
#include "app/simulation/simulated_camera_settings.h"
#include "app/simulation/tracing/renderer.h"
#include "app/simulation/tracing/sensor_noise.h"
#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/frame/frame_pool.h"

namespace orbwatch::app::simulation {

/// Camera in front of a simulated machine. Exposure n is at start + n / rate on the steady clock
/// and shows the process at exactly that moment, exposure_start in the metadata; cameras that share
/// a Machine show one process at any rates. An exposure is lost, a gap in the sequence, when
/// rendering is late by a period or all buffers are lent. During a scripted fault exposures are
/// withheld and the fault is reported once.
/// With control TriggerMode 1, set before start, exposures are at the moments of trigger() instead.
class SimulatedCamera : public hal::Camera {
 public:
  /// `machine` must not be null.
  SimulatedCamera(std::shared_ptr<const Machine> machine, SimulatedCameraSettings settings);
  ~SimulatedCamera() override;

  /// Pose of the camera. Call only after configure().
  const Pinhole& pinhole() const { return pinhole_; }

  /// Errors: not in TriggerMode, the previous exposure is not rendered yet.
  Result<> trigger() override;

 protected:
  /// The only control is TriggerMode, 0 (off) or 1 (on). Error: another one.
  Result<> do_set(std::string_view control, double value) override;
  /// Renders the static scene. Errors: a size, rate, angle or noise out of range, a position inside
  /// a body.
  Result<hal::StreamFormat> do_configure(const hal::StreamRequest& request) override;
  hal::ThreadRole role() const override { return hal::ThreadRole::Service; }
  void run(const std::stop_token& stop) override;

 private:
  bool is_missed(std::uint64_t n, hal::TimePoint moment);
  Result<> check(int width, int height, double frame_rate) const;
  void run_triggered();
  std::optional<hal::TimePoint> take_trigger();
  void expose(std::uint64_t sequence, hal::TimePoint moment);
  void add_noise(hal::FrameBuffer& buffer) const;

  std::shared_ptr<const Machine> machine_;
  SimulatedCameraSettings settings_;
  hal::FaultScript script_;
  hal::StreamFormat format_;
  Pinhole pinhole_;
  std::unique_ptr<const Renderer> renderer_;
  std::optional<SensorNoise> noise_;
  std::optional<hal::FramePool> pool_;
  std::atomic<bool> trigger_mode_ = false;
  std::mutex trigger_mutex_;
  std::optional<hal::TimePoint> trigger_;  ///< moment that is not rendered yet
};

}  // namespace orbwatch::app::simulation
