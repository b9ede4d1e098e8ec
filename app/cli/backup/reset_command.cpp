// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/backup/collect.h"
#include "app/cli/backup/pending_restore.h"
#include "app/cli/backup/placement.h"
#include "app/cli/backup/restoration.h"
#include "app/cli/backup/service_stop.h"
#include "app/cli/backup/site_places.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/files/resolve.h"
#include "app/files/runtime/calibration_file.h"
#include "app/files/runtime/site_file.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kResetUsage =
    "Usage: orbwatch reset --factory [options]\n\n"
    "Puts the delivered configuration back and removes all other files of the configuration,\n"
    "alignments, users, certificates, keys and histories; all of it or, after a failure or a "
    "power\n"
    "cut, nothing. Recordings and pictures stay. The service must be stopped meanwhile:\n"
    "systemctl stop orbwatch, or orbwatch@NAME with --config /etc/orbwatch/NAME/site.toml.\n"
    "`orbwatch backup` keeps what was there.\n\n";

struct ResetOptions {
  fs::path config;
  fs::path delivered = ORBWATCH_DELIVERED_FOLDER;
  bool factory = false;
  bool check = false;
  bool at_start = false;
};

bool is_recording(const std::string& name) {
  constexpr std::array kEndings{".mcap", ".png", ".jpg", ".jpeg", ".mp4", ".avi", ".mkv"};
  return name.starts_with(backup::kConfiguration) &&
         std::ranges::any_of(kEndings, [&](const char* ending) { return name.ends_with(ending); });
}

/// The delivered configuration, and no alignments.
Result<backup::Backup> delivered_files(const fs::path& folder) {
  const fs::path full = backup::full_path(folder);
  auto files = backup::collect(
      {.file = full / "site.toml", .places = {full, {}}, .recordings = {}, .named = {}});
  if (!files) return files;
  files->files.push_back(
      {std::string(backup::kState) + "calibration.toml", files::calibrations_text({}), 0600});
  return files;
}

/// Files of the site that the new ones do not replace.
Result<std::vector<std::string>> removed_names(const fs::path& config,
                                               const backup::Restoration& restoration) {
  backup::Site site{.file = config, .places = restoration.places, .recordings = {}, .named = {}};
  if (const auto present = files::read_site(config)) {
    site = backup::site_of(config, restoration.places.state, *present, {});
  }
  auto names = backup::configuration_names(site);
  if (!names) return names;
  const auto state = backup::state_names(site);
  if (!state) return state;
  names->insert(names->end(), state->begin(), state->end());
  std::erase_if(*names, [&](const std::string& name) {
    return is_recording(name) ||
           std::ranges::count(restoration.files, name, &ArchivedFile::name) > 0;
  });
  return names;
}

/// Replaces the files of the site `config`, now or at the start of orbwatchd. Returns a line about
/// it.
Result<std::string> reset_files(const ResetOptions& o, const fs::path& config,
                                const backup::Restoration& restoration,
                                const std::vector<std::string>& removed) {
  backup::DiskChanges disk;
  if (o.at_start) {
    // The daemon, which runs, writes some of these at its end.
    std::set<std::string> names(removed.begin(), removed.end());
    for (std::string& name : backup::history_names()) names.insert(std::move(name));
    return keep_pending(restoration.places, restoration.files, {names.begin(), names.end()}, disk)
        .map([] { return std::string("reset when orbwatchd starts next\n"); });
  }
  const auto reserved = backup::exclude_daemon(config, restoration.places);
  if (!reserved) return tl::unexpected(reserved.error());
  return replace_files(restoration.places, restoration.files, disk, removed).map([&] {
    return "reset; start it: systemctl start " + unit_of(config) + "\n";
  });
}

CliResult<std::string> reset(const ResetOptions& o) {
  if (!o.factory) return usage_error("say --factory");
  const fs::path config = backup::full_path(files::site_file(o.config));
  const auto delivered = delivered_files(o.delivered);
  if (!delivered) return tl::unexpected(delivered.error());
  const auto undone =
      o.check || o.at_start ? Result<std::string>("") : backup::undo_interrupted(config);
  if (!undone) return tl::unexpected(undone.error());
  const auto restoration = backup::restoration_of(*delivered, config, {});
  if (!restoration) return fail(o.delivered.string() + ": " + restoration.error().message);
  const auto removed = removed_names(config, *restoration);
  if (!removed) return tl::unexpected(removed.error());
  const auto replaceable =
      backup::check_replaceable(restoration->places, restoration->files, *removed);
  if (!replaceable) return tl::unexpected(replaceable.error());
  std::string text = *undone + changes_text(*restoration);
  for (const std::string& name : *removed) {
    text += "removed  " + restoration->places.at(name).string() + "\n";
  }
  if (o.check) return text;
  const auto done = reset_files(o, config, *restoration, *removed);
  if (!done) return tl::unexpected(done.error());
  return text + *done;
}

}  // namespace

CliResult<std::string> reset_command(const Arguments& arguments) {
  ResetOptions o;
  return run_command(
      arguments,
      {.usage = kResetUsage,
       .options = {{"factory", 0, "", "required, since it cannot be undone later",
                    flag_option(o.factory)},
                   {"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
                    text_option(o.config)},
                   {"from", 0, "FOLDER", "another delivered configuration, with a site.toml",
                    text_option(o.delivered)},
                   {"check", 0, "", "only show what would change", flag_option(o.check)},
                   {"at-start", 0, "", "reset when orbwatchd starts next; it may run",
                    flag_option(o.at_start)}}},
      [&](const auto&) { return reset(o); });
}

}  // namespace orbwatch::app::cli
