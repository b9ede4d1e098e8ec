// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>

#include "app/cli/command.h"
#include "app/cli/dds/heard_appliances.h"
#include "app/cli/list/list_text.h"
#include "app/cli/options/dds_options.h"
#include "app/cli/options/options.h"
#include "hal/lines/gpio/gpio_lines.h"
#include "hal/module/module_camera.h"
#include "hal/v4l2/device/v4l2_list.h"

namespace orbwatch::app::cli {
namespace {

constexpr double kUsualSeconds = 4, kMostSeconds = 3600;

struct ListOptions {
  bool json = false;
  bool appliances = false;
  std::optional<double> seconds{};
  int domain = 0;
  std::optional<dds::SecuritySettings> security{};
};

std::vector<Option> declare(ListOptions& o) {
  return {
      {"json", 0, "", "for programs", flag_option(o.json)},
      {"appliances", 0, "",
       "instead: all appliances of a DDS domain, how they are,\nand their pages",
       flag_option(o.appliances)},
      {"seconds", 0, "N", "hear appliances for so long (default 4)",
       [&o](const std::string& v) {
         return parse_number("seconds", v).and_then([&o](double seconds) -> Result<> {
           o.seconds = seconds;
           if (seconds > 0 && seconds <= kMostSeconds) return {};
           return fail("--seconds must be above 0 and at most 3600");
         });
       }},
      domain_option(o.domain),
      security_option(o.security),
  };
}

constexpr const char* kListNotes =
    "\n"
    "--json prints one object: cameras [{camera (its id), back_end, model, driver, bus, paths, "
    "problem\n"
    "(empty: none), advice (how a thermal camera is configured, else empty), modes [{format, "
    "size,\n"
    "frame_rates}], controls [{control, minimum, maximum, step, default, state, values}]}], chips\n"
    "[{chip, path, problem, lines [{line, name, direction, consumer}]}].\n"
    "With --appliances: appliances [{id, name, is_self (false), is_gone (silent for 5 s), age (s "
    "since it\n"
    "was heard), newest (the same as UTC), state, state_text, condition, severity, alarms (that "
    "stand),\n"
    "alarm (the worst of them), alarm_severity, version, prefix, page (null: none for other "
    "computers),\n"
    "pictures (0)}]. It fails with status 1 when no appliance is heard.\n";

/// Lists the devices that are connected now, of every back-end that can list them. Does not disturb
/// streaming cameras.
hal::Inventory take_inventory() {
  hal::Inventory inventory{hal::list_v4l2_cameras(), hal::GpioLines().chips()};
  std::ranges::move(hal::list_module_cameras(), std::back_inserter(inventory.cameras));
  return inventory;
}

CliResult<std::string> list_devices(const ListOptions& o) {
  if (o.seconds) return usage_error("--seconds is of --appliances");
  const hal::Inventory inventory = take_inventory();
  return o.json ? list_json(inventory) : list_table(inventory);
}

CliResult<std::string> list_appliances(const ListOptions& o) {
  const auto duration = std::chrono::ceil<std::chrono::milliseconds>(
      std::chrono::duration<double>(o.seconds.value_or(kUsualSeconds)));
  Fleet fleet;
  const auto heard = hear_appliances(o.domain, o.security, duration, cancelled_by_signal(), fleet);
  if (!heard) return tl::unexpected(heard.error());
  const auto now = hal::Clock::now();
  const auto appliances = fleet.list(now);
  if (appliances.empty()) {
    return fail("DDS: no appliance is heard in domain " + std::to_string(o.domain) +
                "; does an orbwatchd run there, and are the keys right?");
  }
  return o.json ? appliances_json(appliances, now) : appliances_table(appliances);
}

}  // namespace

CliResult<std::string> list_command(const Arguments& arguments) {
  ListOptions o;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch list [options]\n\n"
                "Shows the cameras that are connected, with their modes and "
                "controls, and the\nGPIO chips with their lines; or the appliances "
                "of a DDS domain.\n\n",
       .options = declare(o),
       .notes = kListNotes},
      [&](const auto&) { return o.appliances ? list_appliances(o) : list_devices(o); });
}

}  // namespace orbwatch::app::cli
