// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/boot_restore.h"

#include <optional>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/events/restored_events.h"
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

/// Decrypts the secrets if there is a passphrase.
Result<> open_secrets_in(const fs::path& folder, ReadBackup& read) {
  const auto text = text_of(folder / "passphrase");
  if (!text) return tl::unexpected(text.error());
  if (!*text || read.backup.manifest.secrets != Secrets::Encrypted) return {};
  return open_secrets(read, (*text)->substr(0, (*text)->find_first_of("\r\n")));
}

/// Restores a backup, and records it. Events that have no place do not keep the service from
/// starting.
Result<std::string> restored(const fs::path& config, const fs::path& folder, FrameReader& frames,
                             const std::string& record) {
  auto read = read_backup(frames);
  if (!read) return tl::unexpected(read.error());
  if (const auto opened = open_secrets_in(folder, *read); !opened) {
    return tl::unexpected(opened.error());
  }
  const auto cameras = cameras_in(folder / "cameras");
  if (!cameras) return tl::unexpected(cameras.error());
  const auto restoration = restoration_of(read->backup, config, *cameras);
  if (!restoration) return tl::unexpected(restoration.error());
  const auto reserved = exclude_daemon(restoration->places);
  if (!reserved) return tl::unexpected(reserved.error());
  constexpr mode_t kOwnersFile = 0600;
  DiskChanges disk;
  std::string text = restore_text(read->backup, *restoration);
  // Before the record: an interrupted restore is repeated, and goes on with the missing events.
  if (!restoration->events.empty()) {
    const auto placed = place_events(frames, restoration->events, restoration->event_place, disk);
    if (!placed) text += "not all events are restored: " + shown(placed.error().message) + "\n";
  }
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
  const auto hash = sha256_of(file);
  if (!hash) return tl::unexpected(hash.error());
  const std::string record = *hash + "\n";
  const auto before = hal::read_regular_file(boot_record(*places));
  if (before && *before == record) return std::string();
  auto frames = open_frames(file);
  if (!frames) return tl::unexpected(frames.error());
  auto done = restored(config, folder, *frames, record);
  if (!done) return fail(file.string() + ": " + shown(done.error().message));
  return done;
}

}  // namespace orbwatch::app::cli::backup
