// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/gather.h"

#include <sys/stat.h>
#include <sys/utsname.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <system_error>
#include <tuple>

#include "app/cli/doctor/program_output.h"
#include "app/daemon/site/site_check.h"
#include "app/files/lexical_path.h"
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
    facts.configuration.error = file.string() + ": is not a file";
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

bool is_read_only(const fs::path& folder) {
  return ::access(folder.c_str(), W_OK) != 0 && errno == EROFS;
}

using Properties = std::map<std::string, std::string>;

/// Properties of the units in the output of `systemctl show`, where an empty line separates them.
std::vector<Properties> units_in(const std::string& shown) {
  std::vector<Properties> units(1);
  std::istringstream lines(shown);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find('=');
    if (line.empty()) units.emplace_back();
    if (end != std::string::npos) units.back()[line.substr(0, end)] = line.substr(end + 1);
  }
  return units;
}

template <class Word = std::string>
std::vector<Word> words_of(const std::string& list) {
  std::istringstream in(list);
  return {std::istream_iterator<Word>(in), {}};
}

/// The unit whose environment names the configuration; nullopt: none, or systemd does not answer.
std::optional<Properties> unit_of(const Sources& sources, const fs::path& configuration) {
  std::error_code unknown;
  const fs::path folder = fs::absolute(configuration, unknown).parent_path();
  const auto shown =
      program_output(sources.at("/usr/bin/systemctl"),
                     {"show",
                      "--property=Id,MainPID,Environment,ProtectSystem,ReadWritePaths,"
                      "StateDirectory,ConfigurationDirectory",
                      "orbwatch.service", "orbwatch@" + folder.filename().string() + ".service"});
  for (Properties& unit : units_in(shown.value_or(""))) {
    for (const std::string& word : words_of(unit["Environment"])) {
      if (word.starts_with(kConfigVariable) &&
          is_same_file(word.substr(kConfigVariable.size()), configuration)) {
        return std::move(unit);
      }
    }
  }
  return std::nullopt;
}

/// Folders that a unit with ProtectSystem=strict leaves writable.
std::vector<fs::path> writable_folders(Properties& unit) {
  std::vector<fs::path> folders{"/dev", "/tmp", "/var/tmp"};  // the last two by PrivateTmp=
  for (const std::string& word : words_of(unit["ReadWritePaths"])) {
    folders.emplace_back(word.substr(std::min(word.find_first_not_of("-+"), word.size())));
  }
  for (const std::string& word : words_of(unit["StateDirectory"])) {
    folders.push_back(fs::path("/var/lib") / word);
  }
  for (const std::string& word : words_of(unit["ConfigurationDirectory"])) {
    folders.push_back(fs::path("/etc") / word);
  }
  return folders;
}

/// The numbers in a line of /proc/PID/status.
std::vector<std::int64_t> numbers_of(const fs::path& process, std::string_view key) {
  std::istringstream lines(read_system_file(process / "status").value_or(""));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key)) return words_of<std::int64_t>(line.substr(key.size()));
  }
  return {};
}

/// False if the folder's mode forbids a process to write. Access control lists are not judged.
bool may_write(const fs::path& process, const fs::path& folder) {
  const auto users = numbers_of(process, "Uid:");
  struct stat about {};
  if (users.empty() || users.front() == 0 || ::stat(folder.c_str(), &about) != 0 ||
      ::getxattr(folder.c_str(), "system.posix_acl_access", nullptr, 0) > 0) {
    return true;
  }
  if (users.front() == about.st_uid) return (about.st_mode & S_IWUSR) != 0;
  const auto is_member = [&](std::string_view key) {
    return std::ranges::count(numbers_of(process, key), std::int64_t{about.st_gid}) > 0;
  };
  return (about.st_mode & (is_member("Gid:") || is_member("Groups:") ? S_IWGRP : S_IWOTH)) != 0;
}

/// Access of the unit's service: by its own mounts if it runs and this user is root, else by the
/// unit's properties.
Access access_of(const Sources& sources, Properties& unit, const fs::path& folder) {
  std::error_code unknown;
  // An absolute symbolic link would lead out of the process's root.
  const fs::path real = fs::weakly_canonical(folder, unknown);
  if (unknown) return Access::Unknown;
  const fs::path process = sources.at("/proc") / unit["MainPID"];
  if (fs::is_directory(process / "root", unknown)) {
    const fs::path seen = existing(process / "root" / real.relative_path());
    if (is_read_only(seen)) return Access::ReadOnly;
    return may_write(process, seen) ? Access::Write : Access::Denied;
  }
  if (unit["ProtectSystem"] != "strict") return Access::Unknown;
  const bool is_listed = std::ranges::any_of(writable_folders(unit), [&](const fs::path& listed) {
    return files::is_lexically_below(real, fs::weakly_canonical(sources.at(listed), unknown));
  });
  return is_listed ? Access::Unknown : Access::ReadOnly;
}

FolderFacts folder_facts(const Sources& sources, std::optional<Properties>& unit,
                         const std::string& use, const fs::path& path) {
  std::error_code unknown;
  const fs::path full = path.is_absolute() ? sources.at(path) : fs::absolute(path, unknown);
  const fs::path folder = existing(full);
  FolderFacts facts{.use = use, .path = path};
  const Health health = BoardHealth(health_sources(sources, folder)).read();
  if (signals::is_valid(health.disk_free)) facts.free = health.disk_free;
  if (signals::is_valid(health.disk_free_share)) facts.free_share = health.disk_free_share;
  facts.read_only = is_read_only(folder);
  if (unit) {
    facts.access = access_of(sources, *unit, full);
    facts.unit = fs::path((*unit)["Id"]).stem().string();
  }
  return facts;
}

void gather_folders(const Sources& sources, Facts& facts) {
  if (!facts.site) return;
  auto unit = unit_of(sources, facts.configuration.file);
  const auto add = [&](const std::string& use, const fs::path& folder) {
    if (!folder.empty()) facts.folders.push_back(folder_facts(sources, unit, use, folder));
  };
  const auto state = state_folder(facts.site->state_folder, facts.configuration.file);
  if (state) {
    add("state", *state);
  } else {
    facts.folders.push_back({.use = "state", .path = {}, .error = state.error().message});
  }
  add("snapshots", std::get<SnapshotSettings>(facts.site->sinks).folder);
  add("recordings", std::get<RecorderSettings>(facts.site->sinks).folder);
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

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code unknown;
  return a == b || fs::equivalent(a, b, unknown);
}

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
