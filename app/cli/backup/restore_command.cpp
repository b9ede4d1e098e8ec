// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/boot_restore.h"
#include "app/cli/backup/events/restored_events.h"
#include "app/cli/backup/passphrase.h"
#include "app/cli/backup/pending_restore.h"
#include "app/cli/backup/placement.h"
#include "app/cli/backup/restoration.h"
#include "app/cli/backup/restore_report.h"
#include "app/cli/backup/service_stop.h"
#include "app/cli/backup/site_places.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/files/runtime/site_file.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRestoreUsage =
    "Usage: orbwatch restore FILE [options]\n"
    "       orbwatch restore --undo | --pending\n\n"
    "Restores what `orbwatch backup` wrote, also on another device or of an older version. Checks\n"
    "everything first; then all files are replaced, or, after a failure or a power cut, none.\n"
    "Files that the backup does not have stay. Kept events in it are added to the recordings; "
    "those\n"
    "that are there stay as they are. The service must be stopped meanwhile:\n"
    "systemctl stop orbwatch, or orbwatch@NAME with --config /etc/orbwatch/NAME/site.toml. Lists\n"
    "what depends on the device, such as the cameras' serial numbers.\n\n";

struct RestoreOptions {
  fs::path config;
  fs::path passphrase_file;
  std::vector<backup::CameraAddress> cameras;
  bool without_secrets = false;
  bool without_events = false;
  bool check = false;
  bool json = false;
  bool at_start = false;
  bool undo = false;
  bool pending = false;
};

/// A backup whose events, if it has any, come next.
struct OpenBackup {
  FrameReader frames;
  backup::Backup backup;
};

/// Reads the backup with its secrets, unless they are not wanted.
Result<OpenBackup> open_backup(const RestoreOptions& o, const fs::path& file) {
  auto frames = backup::open_frames(file);
  if (!frames) return tl::unexpected(frames.error());
  auto read = backup::read_backup(*frames);
  if (read && read->backup.manifest.secrets == backup::Secrets::Encrypted && !o.without_secrets) {
    const auto passphrase = backup::passphrase(o.passphrase_file);
    if (!passphrase) return tl::unexpected(passphrase.error());
    const auto opened = backup::open_secrets(*read, *passphrase);
    if (!opened) read = tl::unexpected(opened.error());
  }
  if (!read) return fail(file.string() + ": " + backup::shown(read.error().message));
  if (o.without_events) read->backup.manifest.events.clear();
  return OpenBackup{std::move(*frames), std::move(read->backup)};
}

/// Reads the events of the backup to their end.
Result<> checked_events(OpenBackup& opened, const backup::Restoration& restoration) {
  if (restoration.events.empty()) return {};
  return check_frames(opened.frames, restoration.events, restoration.event_place)
      .map_error([](const Error& error) {
        return Error{"its events cannot be restored: " + backup::shown(error.message) +
                     "; --without-events leaves them out"};
      });
}

/// Adds the events of the backup to the recordings. orbwatchd may run.
Result<> restore_events(OpenBackup& opened, const backup::Restoration& restoration,
                        backup::DiskChanges& disk) {
  if (restoration.events.empty()) return {};
  return place_events(opened.frames, restoration.events, restoration.event_place, disk)
      .map_error([](const Error& error) {
        return Error{"not all events are restored, and nothing else: " +
                     backup::shown(error.message) + "; --without-events leaves them out"};
      });
}

/// Adds the events, and replaces the files of the site `config`, now or at the start of orbwatchd.
/// Returns a line about it.
Result<std::string> replaced(const RestoreOptions& o, const fs::path& config, OpenBackup& opened,
                             const backup::Restoration& restoration) {
  backup::DiskChanges disk;
  const std::vector<std::string> removed = backup::trial_names();
  if (o.at_start) {
    return restore_events(opened, restoration, disk)
        .and_then(
            [&] { return keep_pending(restoration.places, restoration.files, removed, disk); })
        .map([] { return std::string("restored when orbwatchd starts next\n"); });
  }
  const auto reserved = backup::exclude_daemon(config, restoration.places);
  if (!reserved) return tl::unexpected(reserved.error());
  return restore_events(opened, restoration, disk)
      .and_then([&] { return replace_files(restoration.places, restoration.files, disk, removed); })
      .map([&] { return "restored; start it: systemctl start " + unit_of(config) + "\n"; });
}

CliResult<std::string> restore(const RestoreOptions& o, const fs::path& file,
                               const fs::path& config) {
  auto opened = open_backup(o, file);
  if (!opened) return tl::unexpected(opened.error());
  const backup::Backup& backup = opened->backup;
  const auto undone =
      o.check || o.at_start ? Result<std::string>("") : backup::undo_interrupted(config);
  if (!undone) return tl::unexpected(undone.error());
  const auto restoration = backup::restoration_of(backup, config, o.cameras);
  if (!restoration) return fail(file.string() + ": " + backup::shown(restoration.error().message));
  const auto replaceable =
      backup::check_replaceable(restoration->places, restoration->files, backup::trial_names());
  if (!replaceable) return tl::unexpected(replaceable.error());
  const std::string text =
      o.json ? restore_json(backup, *restoration) : *undone + restore_text(backup, *restoration);
  if (o.check) {
    const auto right = checked_events(*opened, *restoration);
    if (!right) return fail(file.string() + ": " + right.error().message);
    return text;
  }
  const auto done = replaced(o, config, *opened, *restoration);
  if (!done) return fail(file.string() + ": " + done.error().message);
  return o.json ? text : text + *done;
}

/// True: options were given that only a backup has a use for.
bool is_about_file(const RestoreOptions& o) {
  return o.check || o.json || o.at_start || o.without_secrets || o.without_events ||
         !o.cameras.empty() || !o.passphrase_file.empty();
}

/// All that is done before orbwatchd starts.
Result<std::string> pending(const fs::path& config) {
  const char* const folder = std::getenv(backup::kBootFolder);
  return backup::complete_pending(config).and_then([&](const std::string& text) {
    return backup::restore_from_boot(config, folder != nullptr ? folder : "")
        .map([&](const std::string& more) { return text + more; });
  });
}

CliResult<std::string> run(const RestoreOptions& o, const std::vector<std::string>& words) {
  const std::size_t asked = words.size() + (o.undo ? 1 : 0) + (o.pending ? 1 : 0);
  if (asked != 1) return usage_error("pass FILE, --undo or --pending");
  if (words.empty() && is_about_file(o)) {
    return usage_error("--undo and --pending take --config only");
  }
  const fs::path config = fs::absolute(files::site_file(o.config)).lexically_normal();
  if (!o.undo && !o.pending) return restore(o, words.front(), config);
  const auto done = o.undo ? backup::undo_interrupted(config) : pending(config);
  if (!done) return tl::unexpected(done.error());
  return *done;
}

Result<> add_camera(const std::string& value, std::vector<backup::CameraAddress>& cameras) {
  auto camera = backup::camera_address(value);
  if (!camera) return fail("--camera: " + camera.error().message);
  cameras.push_back(std::move(*camera));
  return {};
}

}  // namespace

CliResult<std::string> restore_command(const Arguments& arguments) {
  RestoreOptions o;
  return run_command(
      arguments,
      {.usage = kRestoreUsage,
       .options = {{"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
                    text_option(o.config)},
                   {"camera", 0, "NAME=ADDRESS",
                    "device of a camera on this appliance: serial number,\nid or device node; may "
                    "be repeated",
                    [&o](const std::string& value) { return add_camera(value, o.cameras); }},
                   {"passphrase-file", 0, "FILE", "its first line, instead of asking",
                    text_option(o.passphrase_file)},
                   {"without-secrets", 0, "", "keep this device's users, certificates and keys",
                    flag_option(o.without_secrets)},
                   {"without-events", 0, "", "leave out the kept events",
                    flag_option(o.without_events)},
                   {"check", 0, "", "only show what would change", flag_option(o.check)},
                   {"json", 0, "", "show it as JSON", flag_option(o.json)},
                   {"at-start", 0, "", "replace the files when orbwatchd starts next; it may run",
                    flag_option(o.at_start)},
                   {"undo", 0, "", "put the old files back after an interruption",
                    flag_option(o.undo)},
                   {"pending", 0, "",
                    "as --undo; then replace the files that --at-start left, and\nrestore a backup "
                    "in the folder ORBWATCH_RESTORE_FOLDER; for the\nservice",
                    flag_option(o.pending)}},
       .takes_words = true},
      [&](const auto& words) { return run(o, words); });
}

}  // namespace orbwatch::app::cli
