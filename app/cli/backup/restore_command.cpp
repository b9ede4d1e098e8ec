// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/passphrase.h"
#include "app/cli/backup/placement.h"
#include "app/cli/backup/restoration.h"
#include "app/cli/backup/service_stop.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/files/runtime/site_file.h"
#include "app/model/plain_text.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRestoreUsage =
    "Usage: orbwatch restore FILE [options]\n"
    "       orbwatch restore --undo\n\n"
    "Restores what `orbwatch backup` wrote, also on another device or of an older version. Checks\n"
    "everything first; then all files are replaced, or, after a failure or a power cut, none.\n"
    "Files that the backup does not have stay. The service must be stopped meanwhile:\n"
    "systemctl stop orbwatch. Lists what depends on the device, such as the cameras' serial\n"
    "numbers.\n\n";

struct RestoreOptions {
  fs::path config;
  fs::path passphrase_file;
  std::vector<backup::CameraAddress> cameras;
  bool without_secrets = false;
  bool check = false;
  bool undo = false;
};

std::string shown(const std::string& text) {
  constexpr std::size_t kLongest = 4096;
  return plain_text(text, kLongest);
}

/// Reads the backup with its secrets, unless they are not wanted.
Result<backup::Backup> read_backup(const RestoreOptions& o, const fs::path& file) {
  const auto bytes = hal::read_regular_file(file, backup::kMostBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  auto read = backup::parse_backup(*bytes);
  if (read && read->backup.manifest.secrets == backup::Secrets::Encrypted && !o.without_secrets) {
    const auto passphrase = backup::passphrase(o.passphrase_file);
    if (!passphrase) return tl::unexpected(passphrase.error());
    const auto opened = backup::open_secrets(*read, *passphrase);
    if (!opened) read = tl::unexpected(opened.error());
  }
  if (!read) return fail(file.string() + ": " + shown(read.error().message));
  return std::move(read->backup);
}

std::string report(const backup::Backup& backup, const backup::Restoration& restoration) {
  const backup::Manifest& manifest = backup.manifest;
  std::string text = "backup of " + shown(manifest.host) + ", " + shown(manifest.made) +
                     ", orbwatch " + shown(manifest.version) + "\n" + changes_text(restoration);
  if (backup.secrets.empty()) {
    for (const std::string& name : manifest.secret_files) {
      text += "not restored, a secret: " + shown(name) + "\n";
    }
  }
  for (const std::string& line : manifest.left_out) {
    text += "not in the backup: " + shown(line) + "\n";
  }
  for (const std::string& note : restoration.device_notes) {
    text += "depends on the device: " + shown(note) + "\n";
  }
  return text;
}

CliResult<std::string> restore(const RestoreOptions& o, const fs::path& file,
                               const fs::path& config) {
  const auto backup = read_backup(o, file);
  if (!backup) return tl::unexpected(backup.error());
  const auto undone = o.check ? Result<std::string>("") : backup::undo_interrupted(config);
  if (!undone) return tl::unexpected(undone.error());
  const auto restoration = backup::restoration_of(*backup, config, o.cameras);
  if (!restoration) return fail(file.string() + ": " + shown(restoration.error().message));
  const std::string text = *undone + report(*backup, *restoration);
  if (o.check) return text;
  const auto reserved = backup::exclude_daemon(restoration->places);
  if (!reserved) return tl::unexpected(reserved.error());
  backup::DiskChanges disk;
  const auto replaced = backup::replace_files(restoration->places, restoration->files, disk);
  if (!replaced) return tl::unexpected(replaced.error());
  return text + "restored; start it: systemctl start orbwatch\n";
}

CliResult<std::string> run(const RestoreOptions& o, const std::vector<std::string>& words) {
  if (words.size() + (o.undo ? 1 : 0) != 1) return usage_error("say FILE or --undo");
  const fs::path config = fs::absolute(files::site_file(o.config)).lexically_normal();
  if (!o.undo) return restore(o, words.front(), config);
  const auto undone = backup::undo_interrupted(config);
  if (!undone) return tl::unexpected(undone.error());
  return *undone;
}

Result<> add_camera(const std::string& value, std::vector<backup::CameraAddress>& cameras) {
  const std::size_t equals = value.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == value.size()) {
    return fail("--camera is \"" + value + "\"; it must be NAME=ADDRESS");
  }
  cameras.push_back({value.substr(0, equals), value.substr(equals + 1)});
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
                   {"check", 0, "", "only show what would change", flag_option(o.check)},
                   {"undo", 0, "", "put the old files back after an interruption",
                    flag_option(o.undo)}},
       .takes_words = true},
      [&](const auto& words) { return run(o, words); });
}

}  // namespace orbwatch::app::cli
