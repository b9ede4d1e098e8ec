#include <libcamera/property_ids.h>
#include <sys/sysmacros.h>

#include <filesystem>
#include <string>

#include "hal/libcamera/device_nodes.h"

/// libcamera from 0.2 on lists the nodes: properties::SystemDevices.
namespace orbwatch::hal {

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

}  // namespace orbwatch::hal
