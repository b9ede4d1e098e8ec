// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/gather.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <limits>
#include <system_error>
#include <tuple>

#include "app/cli/doctor/program_output.h"
#include "app/daemon/site/site_check.h"
#include "app/files/resolve.h"
#include "app/health/board_health.h"
#include "app/health/system_file.h"
#include "app/state/state_folder.h"
#include "hal/lines/gpio/gpio_lines.h"
#include "hal/module/load_module.h"
#include "hal/module/module_list.h"

namespace orbwatch::app::cli::doctor {
namespace {

namespace fs = std::filesystem;

/// Reads as much as possible: the cameras of a site with a wrong rig can still be checked.
void gather_configuration(const fs::path& file, Facts& facts) {
  facts.configuration.file = file;
  std::error_code unknown;
  facts.configuration.exists = fs::exists(file, unknown);
  if (!facts.configuration.exists) return;
  if (!fs::is_regular_file(file, unknown)) {
    facts.configuration.error = file.string() + ": is no file";
    return;
  }
  auto site = files::resolve(file);
  if (site) {
    const auto checked = daemon::check_site(*site, Dates::Checked);
    if (!checked) facts.configuration.error = checked.error().message;
    facts.site = std::move(site->site);
    return;
  }
  facts.configuration.error = site.error().message;
  if (auto alone = files::read_site(file)) facts.site = std::move(*alone);
}

HealthSources health_sources(const Sources& sources, fs::path disk) {
  return {sources.at("/sys"), sources.at("/proc"), std::move(disk)};
}

/// The folder, or its nearest existing ancestor.
fs::path existing(fs::path folder) {
  std::error_code unknown;
  while (!fs::exists(folder, unknown) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

FolderFacts folder_facts(const Sources& sources, const std::string& use, const fs::path& path) {
  std::error_code unknown;
  const fs::path folder =
      existing(path.is_absolute() ? sources.at(path) : fs::absolute(path, unknown));
  FolderFacts facts{.use = use, .path = path};
  const Health health = BoardHealth(health_sources(sources, folder)).read();
  if (signals::is_valid(health.disk_free)) facts.free = health.disk_free;
  if (signals::is_valid(health.disk_free_share)) facts.free_share = health.disk_free_share;
  facts.read_only = ::access(folder.c_str(), W_OK) != 0 && errno == EROFS;
  return facts;
}

void gather_folders(const Sources& sources, Facts& facts) {
  if (!facts.site) return;
  const auto state = state_folder(facts.site->state_folder, facts.configuration.file);
  if (state) {
    facts.folders.push_back(folder_facts(sources, "state", *state));
  } else {
    facts.folders.push_back({.use = "state", .path = {}, .error = state.error().message});
  }
  const fs::path& snapshots = std::get<SnapshotSettings>(facts.site->sinks).folder;
  if (!snapshots.empty()) {
    facts.folders.push_back(folder_facts(sources, "snapshots", snapshots));
  }
}

void gather_watchdog(const Sources& sources, Facts& facts) {
  WatchdogFacts& watchdog = facts.watchdog;
  watchdog.is_there = sources.has("/dev/watchdog");
  if (auto state = read_system_file(sources.at("/sys/class/watchdog/watchdog0/state"))) {
    watchdog.state = state->substr(0, state->find('\n'));
  }
  const auto shown =
      program_output(sources.at("/usr/bin/systemctl"), {"show", "--property=RuntimeWatchdogUSec"});
  constexpr std::string_view kProperty = "RuntimeWatchdogUSec=";
  if (shown && shown->starts_with(kProperty)) {
    watchdog.systemd_timeout = parse_time_span(std::string_view(*shown).substr(kProperty.size()));
  }
}

struct Unit {
  std::string_view name;
  double seconds;
};
constexpr std::array kUnits{Unit{"us", 1e-6},  Unit{"ms", 1e-3},       Unit{"s", 1},
                            Unit{"min", 60},   Unit{"h", 3600},        Unit{"d", 86400},
                            Unit{"w", 604800}, Unit{"month", 2629800}, Unit{"y", 31557600}};

}  // namespace

std::optional<double> parse_time_span(std::string_view text) {
  constexpr std::string_view kSpace = " \t\n";
  double sum = 0;
  bool is_empty = true;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    if (text.empty()) return is_empty ? std::nullopt : std::optional(sum);
    const std::string_view word = text.substr(0, text.find_first_of(kSpace));
    text.remove_prefix(word.size());
    if (word == "infinity") return std::numeric_limits<double>::infinity();
    double number = 0;
    const char* const end_of_word = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), end_of_word, number);
    if (error != std::errc{} || number < 0) return std::nullopt;
    const std::string_view unit(end, static_cast<std::size_t>(end_of_word - end));
    const auto* const known = std::ranges::find(kUnits, unit, &Unit::name);
    if (known == kUnits.end() && !(unit.empty() && number == 0)) return std::nullopt;
    sum += known == kUnits.end() ? 0 : number * known->seconds;
    is_empty = false;
  }
}

Sources this_computer() {
  Sources sources;
  sources.boards = ORBWATCH_BOARD_FOLDER;
  utsname name{};
  if (::uname(&name) == 0) sources.architecture = name.machine;
  sources.chips = [] { return hal::GpioLines().chips(); };
  sources.module_cameras = [](std::string_view back_end) {
    return hal::module_of(back_end).map(
        [](const hal::CameraModule* module) { return module->list_cameras(); });
  };
  sources.video_module = [] {
    return hal::module_of(hal::kVideoModule).map([](const hal::CameraModule*) {});
  };
  return sources;
}

Facts gather(const Sources& sources, const fs::path& file) {
  Facts facts;
  gather_configuration(file, facts);
  gather_kernel(sources, facts);
  gather_devices(sources, facts);
  gather_limits(sources, facts);
  gather_network(sources, facts);
  gather_folders(sources, facts);
  gather_watchdog(sources, facts);
  facts.health = BoardHealth(health_sources(sources, sources.root)).read();
  facts.has_battery_clock = sources.has("/dev/rtc0");
  return facts;
}

}  // namespace orbwatch::app::cli::doctor
