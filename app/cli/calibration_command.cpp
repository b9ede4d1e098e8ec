// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/text_table.h"
#include "app/files/resolve.h"
#include "app/files/runtime/calibration_file.h"
#include "app/files/runtime/site_file.h"
#include "app/state/private_file.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kCalibrationUsage =
    "Usage: orbwatch calibration history [--config SITE] [--json]\n"
    "       orbwatch calibration restore NUMBER [--config SITE]\n"
    "       orbwatch calibration reset CAMERA [--config SITE]\n"
    "\n"
    "Alignments that orbwatchd accepted by command or corrected by itself are kept in its state\n"
    "folder and are in force instead of what the rig file says, until that is changed. `history`\n"
    "lists them; `restore` puts an earlier one in force again; `reset` goes back to the rig file.\n"
    "A running orbwatchd takes it up by the command restart, or SIGHUP.\n"
    "\n";

constexpr const char* kCalibrationNotes =
    "\n"
    "--json prints one object: alignments [{number, time (UTC), camera, state (in force, earlier, "
    "for\n"
    "another rig file), method, quality}], the oldest first.\n";

/// The alignments of a site.
struct Calibrations {
  std::filesystem::path file;
  std::uint32_t rig = 0;
  std::vector<CalibrationEntry> entries;
};

/// Folder of the calibrations and checksum of the rig, without the entries.
Result<Calibrations> locate(const std::filesystem::path& config) {
  const auto site = files::read_site(config);
  if (!site) return tl::unexpected(site.error());
  const auto folder = state_folder(site->state_folder, config);
  if (!folder) return tl::unexpected(folder.error());
  return files::rig_checksum(site->rig.path).map([&](std::uint32_t rig) {
    return Calibrations{files::calibration_file(*folder), rig, {}};
  });
}

Result<> load(Calibrations& calibrations) {
  files::TextFiles files;
  auto entries = load_calibrations(calibrations.file, files);
  if (!entries) return tl::unexpected(entries.error());
  calibrations.entries = std::move(*entries);
  return {};
}

/// State of an alignment in words: used now or not.
std::string state_of(const CalibrationEntry& entry, const Calibrations& all) {
  const auto current = files::in_force(all.entries, all.rig);
  if (std::ranges::count(current, entry.number, &CalibrationEntry::number) > 0) return "in force";
  return entry.rig == all.rig ? "earlier" : "for another rig file";
}

std::string history_text(const Calibrations& all) {
  if (all.entries.empty()) return "no alignment was accepted: the rig file counts\n";
  std::vector<Fields> records;
  for (const CalibrationEntry& entry : all.entries) {
    records.push_back({{"number", std::to_string(entry.number)},
                       {"time", entry.time},
                       {"camera", camera_of(entry).camera},
                       {"state", state_of(entry, all)},
                       {"method", entry.method},
                       {"quality", entry.quality}});
  }
  return record_lines(records);
}

std::string history_json(const Calibrations& all) {
  using Json = nlohmann::ordered_json;
  Json json{{"alignments", Json::array()}};
  for (const CalibrationEntry& entry : all.entries) {
    json["alignments"].push_back({{"number", entry.number},
                                  {"time", entry.time},
                                  {"camera", camera_of(entry).camera},
                                  {"state", state_of(entry, all)},
                                  {"method", entry.method},
                                  {"quality", entry.quality}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::string> accepted(Calibrations& all, CalibrationEntry entry) {
  const std::string camera = camera_of(entry).camera;
  files::accept(all.entries, std::move(entry));
  const auto saved = files::save_calibrations(all.file, all.entries);
  if (!saved) return tl::unexpected(saved.error());
  return "alignment " + std::to_string(all.entries.back().number) + " of " + camera +
         " counts from the next start or restart of orbwatchd on\n";
}

Result<std::string> restore(Calibrations& all, int number) {
  const std::string word = std::to_string(number);
  const auto found = std::ranges::find(all.entries, number, &CalibrationEntry::number);
  if (found == all.entries.end()) {
    return fail("there is no alignment " + word + "; see orbwatch calibration history");
  }
  if (found->rig != all.rig) {
    return fail("alignment " + word + " is for another rig file; the rig was changed since");
  }
  CalibrationEntry entry = *found;
  entry.method = "restored " + word + ": " + entry.method;
  return accepted(all, std::move(entry));
}

Result<std::string> reset(Calibrations& all, const std::string& camera) {
  const auto of_camera = [&](const CalibrationEntry& entry) {
    return camera_of(entry).camera == camera;
  };
  if (std::ranges::none_of(all.entries, of_camera)) {
    return fail("no alignment of a camera " + camera + " was accepted: the rig file counts");
  }
  CalibrationEntry entry;
  entry.method = "reset to the rig file";
  entry.rig = all.rig;
  entry.alignment.cameras.push_back({.camera = camera});
  return accepted(all, std::move(entry));
}

CliResult<std::string> run(const std::filesystem::path& config, bool json,
                           const std::vector<std::string>& words) {
  const std::string what = words.empty() ? "" : words.front();
  const bool is_right = (what == "history" && words.size() == 1) ||
                        ((what == "restore" || what == "reset") && words.size() == 2);
  if (!is_right) return usage_error("say history, restore NUMBER or reset CAMERA");
  if (json && what != "history") return usage_error("--json is for history");
  const auto number = what == "restore" ? parse_whole(what, words[1]) : Result<int>(0);
  if (!number) return usage_error(number.error().message);
  auto all = locate(config);
  if (!all) return tl::unexpected(all.error());
  if (what == "history") {
    return load(*all).map([&] { return json ? history_json(*all) : history_text(*all); });
  }
  Result<std::string> text;
  // A running orbwatchd may accept one at the same time.
  return with_lock(all->file,
                   [&]() -> Result<> {
                     if (auto loaded = load(*all); !loaded) return loaded;
                     text = what == "restore" ? restore(*all, *number) : reset(*all, words[1]);
                     return {};
                   })
      .and_then([&] { return text; });
}

}  // namespace

CliResult<std::string> calibration_command(const Arguments& arguments) {
  std::filesystem::path config;
  bool json = false;
  return run_command(
      arguments,
      {.usage = kCalibrationUsage,
       .options = {{"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
                    text_option(config)},
                   {"json", 0, "", "history for programs", flag_option(json)}},
       .takes_words = true,
       .notes = kCalibrationNotes},
      [&](const auto& words) { return run(files::site_file(config), json, words); });
}

}  // namespace orbwatch::app::cli
