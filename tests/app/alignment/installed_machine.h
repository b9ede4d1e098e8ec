// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "app/alignment/watched_cameras.h"
#include "app/simulation/machine.h"
#include "app/simulation/tracing/pinhole.h"
#include "app/simulation/tracing/renderer.h"
#include "app/simulation/tracing/sensor_noise.h"
#include "proc/optics/rig.h"

namespace orbwatch::app::tests {

/// A point of the machine and the pixel at which a camera's ball shows it.
struct ShownPoint {
  optics::Vec3 point;
  optics::Vec2 pixel;
};

/// A simulated machine with ball, colour and thermal camera as an installer mounts them at random,
/// and a rig file that is wrong: outlines 5 % too large or small and displaced, the thermal camera
/// turned by 10 degrees. Distances, places and turns are around the demo's. `seed` determines
/// everything.
class InstalledMachine {
 public:
  static constexpr std::size_t kColour = 0, kThermal = 1;

  explicit InstalledMachine(std::uint64_t seed);

  const std::shared_ptr<const simulation::Machine>& machine() const { return machine_; }
  const simulation::Pinhole& camera(std::size_t camera) const { return cameras_[camera]; }
  const optics::Rig& stated() const { return stated_; }
  /// The middle of the work piece's top.
  optics::Vec3 work_piece() const;
  /// The pixel at which the camera's ball shows a point, by plain vectors.
  optics::Vec2 seen_at(std::size_t camera, const optics::Vec3& point) const;
  /// At most `count` corners of the machine, well apart, which the ball shows clearly.
  std::vector<ShownPoint> corners(std::size_t camera, std::size_t count,
                                  std::mt19937_64& random) const;

 private:
  bool is_clear(std::size_t camera, const optics::Vec3& point) const;
  optics::Rig true_rig() const;

  std::shared_ptr<const simulation::Machine> machine_;
  std::array<simulation::Pinhole, 2> cameras_;
  optics::Rig stated_;
};

/// The cameras of an installed machine, whose pictures are rendered as they are asked for.
class RenderedCameras : public WatchedCameras {
 public:
  explicit RenderedCameras(const InstalledMachine& installed, std::uint64_t seed);

  bool is_watched(std::size_t /*camera*/) const override { return true; }
  hal::Fault fault(std::size_t /*camera*/) const override { return hal::Fault::None; }
  std::optional<align::DriftState> drift(std::size_t /*camera*/) const override { return {}; }
  void ask(std::size_t camera, std::function<void(RecordedPicture)> reader) override;
  void ask_together(std::vector<std::size_t> cameras,
                    std::function<void(Result<std::vector<RecordedPicture>>)> reader) override;
  Result<std::vector<std::vector<RecordedPicture>>> record(
      const std::vector<std::size_t>& cameras, std::size_t count, std::chrono::seconds patience,
      const align::WorkProgress& progress) override;
  const std::shared_ptr<hal::SharedThreads>& threads() const override { return threads_; }

 private:
  RecordedPicture picture(std::size_t camera) const;

  std::vector<simulation::Renderer> renderers_;
  std::vector<simulation::SensorNoise> noises_;
  std::array<simulation::Pinhole, 2> cameras_;
  std::uint64_t frame_ = 0;  ///< frame sets of 15 per second
  const std::shared_ptr<hal::SharedThreads> threads_ = hal::SharedThreads::alone();
};

}  // namespace orbwatch::app::tests
