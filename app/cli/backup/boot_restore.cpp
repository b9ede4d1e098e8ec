// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/boot_restore.h"

#include <optional>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/placement.h"
#include "app/cli/backup/restoration.h"
#include "app/cli/backup/restore_report.h"
#include "app/cli/backup/sealing.h"
#include "app/cli/backup/service_stop.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;

/// Text of a file of the folder; nullopt: absent.
Result<std::optional<std::string>> text_of(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(file, none)) return std::nullopt;
  return hal::read_regular_file(file).map(
      [](std::string text) { return std::optional(std::move(text)); });
}

Result<std::vector<CameraAddress>> cameras_in(const fs::path& file) {
  const auto text = text_of(file);
  if (!text) return tl::unexpected(text.error());
  std::vector<CameraAddress> cameras;
  std::istringstream lines(text->value_or(""));
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    const auto camera = camera_address(line);
    if (!camera) return fail(file.string() + ": " + camera.error().message);
    cameras.push_back(*camera);
  }
  return cameras;
}

/// The backup, with its secrets if there is a passphrase.
Result<Backup> backup_in(const fs::path& folder, const std::string& bytes) {
  auto read = parse_backup(bytes);
  if (!read) return tl::unexpected(read.error());
  const auto text = text_of(folder / "passphrase");
  if (!text) return tl::unexpected(text.error());
  if (*text && read->backup.manifest.secrets == Secrets::Encrypted) {
    const std::string passphrase = (*text)->substr(0, (*text)->find_first_of("\r\n"));
    if (const auto opened = open_secrets(*read, passphrase); !opened) {
      return tl::unexpected(opened.error());
    }
  }
  return std::move(read->backup);
}

/// Restores `bytes`, and records them.
Result<std::string> restored(const fs::path& config, const fs::path& folder,
                             const std::string& bytes, const std::string& record) {
  const auto backup = backup_in(folder, bytes);
  if (!backup) return tl::unexpected(backup.error());
  const auto cameras = cameras_in(folder / "cameras");
  if (!cameras) return tl::unexpected(cameras.error());
  const auto restoration = restoration_of(*backup, config, *cameras);
  if (!restoration) return tl::unexpected(restoration.error());
  const auto reserved = exclude_daemon(restoration->places);
  if (!reserved) return tl::unexpected(reserved.error());
  constexpr mode_t kOwnersFile = 0600;
  DiskChanges disk;
  const std::string text = restore_text(*backup, *restoration);
  return replace_files(restoration->places, restoration->files, disk)
      .and_then([&] { return disk.write(boot_record(restoration->places), record, kOwnersFile); })
      .map([&] { return text + "restored from " + folder.string() + "\n"; });
}

}  // namespace

fs::path boot_record(const SitePlaces& places) { return places.state / "restored-from-boot"; }

Result<std::string> restore_from_boot(const fs::path& config, const fs::path& folder) {
  const fs::path file = folder / "restore.tar.zst";
  std::error_code none;
  if (folder.empty() || !fs::exists(file, none)) return std::string();
  const auto places = present_places(config);
  if (!places) return tl::unexpected(places.error());
  const auto bytes = hal::read_regular_file(file, kMostBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string record = sha256(*bytes) + "\n";
  const auto before = hal::read_regular_file(boot_record(*places));
  if (before && *before == record) return std::string();
  auto done = restored(config, folder, *bytes, record);
  if (!done) return fail(file.string() + ": " + shown(done.error().message));
  return done;
}

}  // namespace orbwatch::app::cli::backup
