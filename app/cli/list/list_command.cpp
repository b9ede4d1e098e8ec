#include <algorithm>
#include <iterator>

#include "app/cli/command.h"
#include "app/cli/list/list_text.h"
#include "app/cli/options/options.h"
#include "hal/lines/gpio/gpio_lines.h"
#include "hal/module/module_camera.h"
#include "hal/v4l2/device/v4l2_list.h"

namespace orbwatch::app {
namespace {

constexpr const char* kNotes =
    "\n"
    "--json prints one object: cameras [{camera (its id), back_end, model, driver, bus, paths, "
    "problem\n"
    "(empty: none), modes [{format, size, frame_rates}], controls [{control, minimum, maximum, "
    "step,\n"
    "default, state, values}]}], chips [{chip, path, problem, lines [{line, name, direction, "
    "consumer}]}].\n";

/// The devices that are connected now, of every back-end that can list them. Does not disturb
/// streaming cameras.
hal::Inventory take_inventory() {
  hal::Inventory inventory{hal::list_v4l2_cameras(), hal::GpioLines().chips()};
  std::ranges::move(hal::list_module_cameras(), std::back_inserter(inventory.cameras));
  return inventory;
}

}  // namespace

Result<std::string> list_command(const std::vector<std::string>& arguments) {
  bool json = false;
  return run_command(arguments,
                     {.usage = "Usage: orbwatch list [--json]\n\n"
                               "Shows the cameras that are connected, with their modes and "
                               "controls, and the\nGPIO chips with their lines.\n\n",
                      .options = {{"json", 0, "", "for programs", flag_option(json)}},
                      .notes = kNotes},
                     [&](const auto&) -> Result<std::string> {
                       const hal::Inventory inventory = take_inventory();
                       return json ? list_json(inventory) : list_table(inventory);
                     });
}

}  // namespace orbwatch::app
