#include <utility>

#include "app/cli/list/list.h"
#include "hal/libcamera/libcamera_list.h"
#include "hal/lines/gpio/gpio_lines.h"
#include "hal/v4l2/device/v4l2_list.h"

namespace orbwatch::app {

hal::Inventory take_inventory() {
  hal::Inventory inventory{hal::list_v4l2_cameras(), hal::GpioLines().chips()};
  for (auto& camera : hal::list_libcamera_cameras()) {
    inventory.cameras.push_back(std::move(camera));
  }
  return inventory;
}

}  // namespace orbwatch::app
