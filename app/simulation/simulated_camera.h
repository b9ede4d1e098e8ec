#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/simulation/camera_truth.h"
#include "app/simulation/machine.h"
#include "app/simulation/renderer.h"
#include "app/simulation/sensor_noise.h"
#include "hal/camera.h"
#include "hal/fault_script.h"
#include "hal/frame_pool.h"

namespace orbwatch::app::simulation {

/// One camera on the machine. It looks at the ball's centre with the picture's up as near to +Z as
/// possible.
struct SimulatedCameraSettings {
  std::string name;  ///< becomes CameraInfo::id; also part of the noise's seed
  CameraKind kind = CameraKind::Colour;
  Vec3 position{160, -430, 480};  ///< mm, machine frame; outside the enclosure walls are windows
  double horizontal_fov = 13;     ///< degrees from picture edge to picture edge
  int width = 1000;               ///< pixels, unless configure() asks for another size
  int height = 1000;
  double frame_rate = 15;          ///< per second, unless configure() asks for another rate
  double noise_sigma = 2;          ///< counts, Gaussian; 0: none
  double kelvin_per_count = 0.04;  ///< thermal only: sample = T in K / kelvin_per_count
  std::vector<hal::ScriptedFault> faults;
};

/// A camera that sees a simulated machine. Exposure n is at start + n / rate on the steady clock
/// and shows the process at exactly that moment, exposure_start in the metadata; cameras that share
/// a Machine so see one process, whatever their rates. An exposure that is over before the one
/// before it was drawn is lost, as is one that finds all buffers lent: the sequence shows the gap.
/// While a scripted fault lasts, exposures are withheld and the fault is reported once.
/// With control TriggerMode 1, set before start, exposures are at the moments of trigger() instead.
class SimulatedCamera : public hal::Camera {
 public:
  /// `machine` must not be null.
  SimulatedCamera(std::shared_ptr<const Machine> machine, SimulatedCameraSettings settings);
  ~SimulatedCamera() override;

  /// Where the camera stands and what alignment should find. After configure() only.
  const Pinhole& pinhole() const { return pinhole_; }
  CameraTruth truth() const { return truth_of(pinhole_, machine_->settings().ball); }

  /// Errors: not in TriggerMode, the exposure before is not drawn yet.
  Result<> trigger() override;
  /// The only control is TriggerMode, 0 (off) or 1 (on). Error: another one.
  Result<> set(std::string_view control, double value) override;

 protected:
  /// Traces what stands still. Errors: a size, rate, angle or noise out of range, a position inside
  /// a body.
  Result<hal::StreamFormat> do_configure(const hal::StreamRequest& request) override;
  void run(const std::stop_token& stop) override;

 private:
  Result<> check(int width, int height, double frame_rate) const;
  void run_triggered(const std::stop_token& stop);
  std::optional<hal::TimePoint> next_trigger(const std::stop_token& stop);
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
  std::condition_variable_any triggered_;
  std::optional<hal::TimePoint> trigger_;  ///< not drawn yet
};

}  // namespace orbwatch::app::simulation
