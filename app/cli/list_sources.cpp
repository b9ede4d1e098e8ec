#include <utility>

#include "app/cli/list.h"
#include "hal/libcamera/libcamera_list.h"
#include "hal/lines/gpio_lines.h"
#include "hal/v4l2/v4l2_list.h"

namespace orbwatch::app {
namespace {

std::string size_text(const hal::FrameSizeOffer& size) {
  const auto text = [](std::uint32_t width, std::uint32_t height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  const std::string least = text(size.min_width, size.min_height);
  const std::string most = text(size.max_width, size.max_height);
  return least == most ? least : least + ".." + most;
}

hal::CameraControl control_entry(hal::V4l2ControlInfo control) {
  hal::CameraControl entry{.name = std::move(control.name),
                           .minimum = static_cast<double>(control.minimum),
                           .maximum = static_cast<double>(control.maximum),
                           .step = static_cast<double>(control.step),
                           .default_value = static_cast<double>(control.default_value),
                           .state = control.read_only  ? "read only"
                                    : control.inactive ? "inactive"
                                                       : "",
                           .values = {}};
  for (const auto& [value, text] : control.menu) {
    entry.values.push_back(std::to_string(value) + " = " + text);
  }
  return entry;
}

hal::CameraEntry camera_entry(hal::V4l2DeviceInfo device) {
  hal::CameraEntry camera{.id = {},
                          .back_end = "v4l2",
                          .model = std::move(device.card),
                          .driver = std::move(device.driver),
                          .bus = std::move(device.bus),
                          .paths = std::move(device.stable_paths),
                          .problem = std::move(device.problem),
                          .modes = {},
                          .controls = {}};
  camera.paths.push_back(std::move(device.path));
  camera.id = camera.paths.front();
  for (const hal::V4l2FormatInfo& format : device.formats) {
    for (const hal::V4l2SizeInfo& size : format.sizes) {
      camera.modes.push_back({format.pixel_format.empty() ? format.fourcc : format.pixel_format,
                              size_text(size.size), size.frame_rates});
    }
  }
  for (auto& control : device.controls) {
    camera.controls.push_back(control_entry(std::move(control)));
  }
  return camera;
}

hal::ChipEntry chip_entry(const hal::ChipInfo& chip) {
  hal::ChipEntry entry{chip.label, chip.path, chip.error, {}};
  for (const hal::LineInfo& line : chip.lines) {
    const bool anonymous = line.is_used && line.consumer.empty();
    entry.lines.push_back({line.offset, line.name, line.is_output ? "output" : "input",
                           anonymous ? "in use" : line.consumer});
  }
  return entry;
}

}  // namespace

hal::Inventory take_inventory() {
  hal::Inventory inventory;
  for (auto& device : hal::list_v4l2_devices()) {
    inventory.cameras.push_back(camera_entry(std::move(device)));
  }
  for (auto& camera : hal::list_libcamera_cameras()) {
    inventory.cameras.push_back(std::move(camera));
  }
  for (const hal::ChipInfo& chip : hal::GpioLines().chips()) {
    inventory.chips.push_back(chip_entry(chip));
  }
  return inventory;
}

}  // namespace orbwatch::app
