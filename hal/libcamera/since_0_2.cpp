// SPDX-License-Identifier: Apache-2.0
#include <libcamera/property_ids.h>
#include <sys/sysmacros.h>

#include <filesystem>
#include <string>

#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/format/camera_configuration.h"

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

/// libcamera from 0.2 on lists the nodes: properties::SystemDevices.
bool has_lost_its_nodes(const libcamera::Camera& camera) {
  const auto nodes = camera.properties().get(libcamera::properties::SystemDevices);
  if (!nodes) return false;
  for (const std::int64_t node : *nodes) {
    const auto number = static_cast<dev_t>(node);
    const std::string name =
        std::to_string(gnu_dev_major(number)) + ":" + std::to_string(gnu_dev_minor(number));
    std::error_code error;
    if (!std::filesystem::exists("/sys/dev/char/" + name, error)) return true;
  }
  return false;
}

/// libcamera from 0.2 on: CameraConfiguration::sensorConfig. Pipelines without support ignore it
/// silently, so an impossible mode is requested first: a pipeline with support refuses it.
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
