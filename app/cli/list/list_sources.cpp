#include <utility>

#include "app/cli/list/list.h"
#include "hal/libcamera/libcamera_list.h"
#include "hal/lines/gpio/gpio_lines.h"
#include "hal/v4l2/device/v4l2_list.h"

namespace orbwatch::app {
namespace {

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
  inventory.cameras = hal::list_v4l2_cameras();
  for (auto& camera : hal::list_libcamera_cameras()) {
    inventory.cameras.push_back(std::move(camera));
  }
  for (const hal::ChipInfo& chip : hal::GpioLines().chips()) {
    inventory.chips.push_back(chip_entry(chip));
  }
  return inventory;
}

}  // namespace orbwatch::app
