#include "app/daemon/cameras.h"

#include "app/simulation/simulated_camera.h"
#include "hal/libcamera/libcamera_camera.h"
#include "hal/replay/replay_camera.h"
#include "hal/v4l2/v4l2_camera.h"

namespace orbwatch::app {
namespace {

simulation::SimulatedCameraSettings simulated_settings(const CameraSettings& settings) {
  const SimulatedCameraPart& part = *settings.simulated;
  simulation::SimulatedCameraSettings simulated;
  simulated.name = settings.name;
  simulated.kind = part.kind == SimulatedCameraPart::Kind::Thermal ? simulation::CameraKind::Thermal
                                                                   : simulation::CameraKind::Colour;
  simulated.position = part.position;
  simulated.horizontal_fov = part.h_fov;
  simulated.noise_sigma = part.noise;
  if (settings.kelvin_per_count > 0) simulated.kelvin_per_count = settings.kelvin_per_count;
  simulated.faults = settings.faults;
  return simulated;
}

hal::LibcameraSettings libcamera_settings(const LibcameraPart& part) {
  return {part.camera,
          part.pixel_format,
          {part.sensor_width, part.sensor_height, part.sensor_bit_depth}};
}

}  // namespace

std::unique_ptr<hal::Camera> make_camera(
    const CameraSettings& settings, const std::shared_ptr<const simulation::Machine>& machine) {
  switch (settings.back_end) {
    case BackEnd::Simulated:
      return std::make_unique<simulation::SimulatedCamera>(machine, simulated_settings(settings));
    case BackEnd::Replay:
      return std::make_unique<hal::ReplayCamera>(
          hal::ReplaySettings{settings.name, settings.replay->source, settings.frame_rate,
                              settings.replay->loop, settings.faults});
    case BackEnd::V4l2:
      return std::make_unique<hal::V4l2Camera>(hal::V4l2Settings{
          settings.v4l2->device, settings.v4l2->pixel_format, settings.v4l2->colour});
    case BackEnd::Libcamera:
      return std::make_unique<hal::LibcameraCamera>(libcamera_settings(*settings.libcamera));
  }
  return nullptr;
}

}  // namespace orbwatch::app
