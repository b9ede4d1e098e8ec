// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/simulation/tracing/ray.h"
#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/fault.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::simulation {

class Machine;

enum class CameraKind : std::uint8_t {
  Colour,   ///< Rgb: each pixel is the mean light of four points in it
  Thermal,  ///< Y16, radiometric: each pixel is the temperature at its centre
};

/// Camera on the machine. It points at the ball's centre, upright (picture's up nearest to +Z).
struct SimulatedCameraSettings {
  static constexpr std::string_view kName = "simulated";
  static constexpr hal::BackEndFacts kFacts{.origin = hal::CameraOrigin::Process,
                                            .needs_size = true};

  std::string name{};  ///< becomes CameraInfo::id; also part of the noise's seed
  CameraKind kind = CameraKind::Colour;
  Vec3 position{
      160, -430,
      480};  ///< machine frame, mm; for a position outside the enclosure walls are windows
  double horizontal_fov = 13;  ///< degrees from picture edge to picture edge
  int width = 1000;            ///< pixels, unless configure() requests another size
  int height = 1000;
  double frame_rate = 15;          ///< per second, unless configure() requests another rate
  double noise_sigma = 1;          ///< counts, Gaussian; 0: none
  double kelvin_per_count = 0.04;  ///< thermal only: see kelvin_of_counts()
  std::vector<hal::ScriptedFault> faults{};
  double kelvin_offset = 0;  ///< thermal only: K, of a count of 0

  std::optional<PixelFormat> stated_format() const {
    return kind == CameraKind::Colour ? PixelFormat::Rgb : PixelFormat::Y16;
  }
};

inline constexpr std::array kCameraKinds{Word{"colour", CameraKind::Colour},
                                         Word{"thermal", CameraKind::Thermal}};

/// Visits all settings except those from the camera's context.
template <class Visitor>
void visit(Visitor& v, SimulatedCameraSettings& settings) {
  v.required("kind", settings.kind, kCameraKinds, "colour: 8-bit RGB; thermal: 16-bit radiometric");
  v.required("position", settings.position, kAnyNumber,
             "Camera position, machine frame, mm; the camera looks at the ball");
  v.required("h_fov", settings.horizontal_fov, Range::inside(0, 180),
             "Horizontal field of view, deg");
  v.optional("noise", settings.noise_sigma, Range::between(0, 1000),
             "Standard deviation of the sensor noise, counts");
}

/// Context for making a simulated camera, with the machine that all of them share.
struct SimulationContext : hal::CameraContext {
  std::shared_ptr<const Machine> machine;
};

std::unique_ptr<hal::Camera> make_camera(SimulatedCameraSettings settings,
                                         const SimulationContext& context);

}  // namespace orbwatch::app::simulation
