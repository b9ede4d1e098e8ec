// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/site_check.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/daemon/recorded_machine.h"
#include "app/daemon/site/recorded_cameras.h"
#include "app/daemon/site/view_memory.h"
#include "app/pipeline/measurement/compiled_recipe.h"
#include "hal/host.h"
#include "hal/thread/scheduling.h"

namespace orbwatch::app::daemon {

namespace {

bool meet(const ListeningPort& a, const ListeningPort& b) {
  return a.interface != b.interface && a.port == b.port &&
         (a.address == b.address || hal::is_unspecified(a.address) ||
          hal::is_unspecified(b.address));
}

std::string text_of(const ListeningPort& port) {
  return "[" + std::string(port.interface) + "] " + std::string(port.key);
}

/// Checks what the enabled interfaces need to start, besides ports, keys and memory.
Result<> check_interfaces(const files::Resolved& site) {
  Result<> checked;
  files::for_each_sink(site.site.sinks, [&](const auto& settings) {
    if constexpr (requires { check_settings(settings); }) {
      if (checked) checked = check_settings(settings);
    }
  });
  return checked;
}

/// Error: the interface that receives the states of the machine is not enabled.
template <class Settings>
Result<> check_source(const files::Resolved& site) {
  if (std::get<Settings>(site.site.sinks).enabled) return {};
  const std::string table = "[" + std::string(Settings::kName) + "]";
  return fail("machine.source is " + std::string(name_of(site.site.machine.source)) + ", but " +
              table + " is not enabled; set enabled = true in " + table + ", or another source");
}

Result<> check_machine(const files::Resolved& site) {
  switch (site.site.machine.source) {
    case MachineSource::Modbus:
      return check_source<ModbusSettings>(site);
    case MachineSource::Dds:
      return check_source<DdsSettings>(site);
    case MachineSource::Http:
      return check_source<WebSettings>(site);
    case MachineSource::Recording:
      return replayed_recording(site).map([](const std::filesystem::path&) {});
    case MachineSource::None:
    case MachineSource::Simulation:
      return {};
  }
  return {};
}

/// Use of a camera or line of this computer.
struct UsedDevice {
  std::string user;     ///< name in the file
  std::string address;  ///< empty: it is chosen when the device is opened
};

/// Error: two have the same device. `kind`: cameras or lines.
Result<> check_devices(const std::string& kind, const std::vector<UsedDevice>& devices) {
  for (auto later = devices.begin(); later != devices.end(); ++later) {
    if (later->address.empty()) continue;
    const auto earlier = std::find_if(devices.begin(), later, [&](const UsedDevice& other) {
      return other.address == later->address;
    });
    if (earlier == later) continue;
    return fail(kind + " " + earlier->user + " and " + later->user + " are both " + later->address +
                "; give each one of its own");
  }
  return {};
}

/// A camera can be opened once; a recording may be replayed twice.
Result<> check_cameras(const files::Resolved& site) {
  std::vector<UsedDevice> devices;
  for (const files::CameraSettings& camera : site.site.cameras) {
    const hal::CameraOrigin origin = files::facts_of(camera.back_end).origin;
    if (origin != hal::CameraOrigin::Kernel && origin != hal::CameraOrigin::Module) continue;
    devices.push_back({camera.name, files::address_of(camera.back_end)});
  }
  return check_devices("cameras", devices);
}

/// A line can be opened once; simulated ones of one name are a wire from an output to an input.
Result<> check_lines(const files::Resolved& site) {
  std::vector<UsedDevice> devices;
  for (const LineSettings& line : site.site.lines) {
    if (line.back_end == LineKind::Gpio) devices.push_back({line.name, line.wire.address.text()});
  }
  return check_devices("lines", devices);
}

}  // namespace

std::vector<ListeningPort> listening_ports(const files::SinkSettings& sinks) {
  std::vector<ListeningPort> ports;
  files::for_each_sink(sinks, [&ports](const auto& settings) {
    if constexpr (requires { listening_ports(settings); }) {
      for (ListeningPort& port : listening_ports(settings)) {
        if (port.port != 0) ports.push_back(std::move(port));
      }
    }
  });
  return ports;
}

Result<> check_keys(const files::Resolved& site, Dates dates) {
  Result<> checked;
  files::for_each_sink(site.site.sinks, [&](const auto& settings) {
    if constexpr (requires { check_keys(settings, dates); }) {
      if (checked) checked = check_keys(settings, dates);
    }
  });
  return checked;
}

Result<> check_ports(const files::Resolved& site) {
  const auto ports = listening_ports(site.site.sinks);
  for (auto later = ports.begin(); later != ports.end(); ++later) {
    const auto earlier = std::find_if(
        ports.begin(), later, [&](const ListeningPort& other) { return meet(other, *later); });
    if (earlier == later) continue;
    return fail(text_of(*later) + " and " + text_of(*earlier) + " are both " +
                std::to_string(later->port) + "; give each a port of its own");
  }
  return {};
}

Result<> check_recordings(const files::Resolved& site) {
  const auto cameras = recorded_cameras(site, expected_formats(site));
  Result<> checked;
  files::for_each_sink(site.site.sinks, [&](const auto& settings) {
    if constexpr (requires { check_recorded(settings, cameras); }) {
      if (checked) checked = check_recorded(settings, cameras);
    }
  });
  return checked;
}

Result<SitePlan> checked_plan(const files::Resolved& site, Dates dates) {
  if (auto fits = check_view_memory(site); !fits) return tl::unexpected(fits.error());
  auto plan = SitePlan::make(site, expected_formats(site));
  if (!plan) return plan;
  for (std::size_t i = 0; i < plan->recipes.size(); ++i) {
    const auto checked = pipeline::CompiledRecipe::check(plan->recipes[i], plan->scene);
    if (!checked) return tl::unexpected(in_recipe(site, i, checked.error()));
  }
  return hal::check(site.site.threads)
      .and_then([&] { return check_ports(site); })
      .and_then([&] { return check_interfaces(site); })
      .and_then([&] { return check_keys(site, dates); })
      .and_then([&] { return check_recordings(site); })
      .and_then([&] { return check_machine(site); })
      .and_then([&] { return check_cameras(site); })
      .and_then([&] { return check_lines(site); })
      .map([&] { return std::move(*plan); });
}

Result<> check_site(const files::Resolved& site, Dates dates) {
  return checked_plan(site, dates).map([](const SitePlan&) {});
}

}  // namespace orbwatch::app::daemon
