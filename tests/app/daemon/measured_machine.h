// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "app/pictures/colour_maps.h"
#include "app/simulation/tracing/renderer.h"
#include "app/simulation/tracing/sensor_noise.h"
#include "hal/frame/frame_pool.h"
#include "proc/signals/region_meter.h"
#include "tests/app/daemon/simulated_scene.h"
#include "tests/app/pipeline/views/rendered_view.h"

namespace orbwatch::app::daemon {

inline constexpr double kKelvinPerCount = 0.04;
inline double counts(double celsius) { return (celsius + 273.15) / kKelvinPerCount; }

/// Thermal camera that looks at a ray-traced machine, its measurement view, and one region there:
/// the product's own path from a frame to signals.
class MeasuredMachine {
 public:
  MeasuredMachine(const simulation::MachineSettings& settings, const simulation::Pinhole& pinhole,
                  const optics::ViewSpec& view, const signals::RegionSettings& region)
      : machine_(simulation::Machine::make(settings, {}).value()),
        projection_(projection_of(pinhole, region_scene_of(settings))),
        renderer_(machine_, pinhole, {simulation::CameraKind::Thermal, kKelvinPerCount}),
        buffers_(hal::make_frame_pool(PixelFormat::Y16, pinhole.width, pinhole.height, 1)),
        view_(plan(pinhole, view)),
        workers_(0),
        meter_(
            signals::RegionMeter::make(view_.plan().projection, region_scene_of(settings), region)
                .value()) {}

  /// Signals for the machine's state `seconds` after its epoch. `spoil` may change the frame before
  /// it is used: ImageView<uint16_t>.
  template <class Spoil>
  signals::Signals measure(double seconds, const Spoil& spoil) {
    auto buffer = buffers_.acquire();
    renderer_.render(seconds, buffer->memory);
    const int width = buffer->picture.width, height = buffer->picture.height;
    spoil(ImageView<std::uint16_t>{reinterpret_cast<std::uint16_t*>(buffer->memory), width, height,
                                   1, width});
    hal::FrameSet set;
    set.frames[0] = buffer;
    const View& rendered = view_.render(set, workers_);
    return meter_.measure(rendered.radiometric, rendered.validity, seconds);
  }
  signals::Signals measure(double seconds) {
    return measure(seconds, [](const ImageView<std::uint16_t>&) {});
  }

  const signals::RegionMeter& meter() const { return meter_; }

 private:
  pipeline::ViewPlan plan(const simulation::Pinhole& pinhole, const optics::ViewSpec& view) const {
    pipeline::ViewPlan plan{
        0, "region", optics::ViewProjection::make(view, projection_).value(), {}, {}, {}, 0};
    plan.sources.push_back({0,
                            {PixelFormat::Y16, {}, pinhole.width, pinhole.height, 30},
                            projection_,
                            1,
                            {colour_map_table("grey"), 0, 65535}});
    plan.interpolation = remap::Interpolation::Area;
    return plan;
  }

  std::shared_ptr<const simulation::Machine> machine_;
  optics::BallProjection projection_;
  simulation::Renderer renderer_;
  hal::FramePool buffers_;
  pipeline::RenderedView view_;
  pipeline::WorkerPool workers_;
  signals::RegionMeter meter_;
};

}  // namespace orbwatch::app::daemon
