#include "hal/libcamera/format/sensor_mode.h"

/// libcamera from 0.2 on: CameraConfiguration::sensorConfig. Pipelines without support ignore it
/// silently, so an impossible mode is requested first: a pipeline with support refuses it.
namespace orbwatch::hal {
namespace {

libcamera::SensorConfiguration to_libcamera(const SensorMode& mode) {
  libcamera::SensorConfiguration sensor;
  sensor.bitDepth = static_cast<unsigned>(mode.bit_depth);
  sensor.outputSize =
      libcamera::Size(static_cast<unsigned>(mode.width), static_cast<unsigned>(mode.height));
  return sensor;
}

bool takes_modes(libcamera::CameraConfiguration& configuration) {
  constexpr SensorMode kImpossible{1, 1, 1};
  configuration.sensorConfig = to_libcamera(kImpossible);
  return configuration.validate() == libcamera::CameraConfiguration::Invalid;
}

}  // namespace

Result<std::unique_ptr<libcamera::CameraConfiguration>> begin_configuration(
    libcamera::Camera& camera, const SensorMode& mode) {
  auto configuration = camera.generateConfiguration({libcamera::StreamRole::VideoRecording});
  if (!configuration || configuration->empty()) return fail("has no stream for video");
  if (!mode.is_set()) return configuration;
  if (!takes_modes(*configuration)) return fail("its sensor mode cannot be chosen");
  configuration = camera.generateConfiguration({libcamera::StreamRole::VideoRecording});
  if (!configuration || configuration->empty()) return fail("has no stream for video");
  configuration->sensorConfig = to_libcamera(mode);
  return configuration;
}

bool has_sensor_mode(const libcamera::CameraConfiguration& validated, const SensorMode& mode) {
  if (!mode.is_set()) return true;
  const auto& sensor = validated.sensorConfig;
  const libcamera::SensorConfiguration wanted = to_libcamera(mode);
  return sensor && sensor->bitDepth == wanted.bitDepth && sensor->outputSize == wanted.outputSize;
}

}  // namespace orbwatch::hal
