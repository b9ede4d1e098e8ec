// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/boot_restore.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/events/restored_events.h"
#include "app/cli/backup/passphrase.h"
#include "app/cli/backup/placement.h"
#include "app/cli/backup/restoration.h"
#include "app/cli/backup/restore_report.h"
#include "app/cli/backup/service_stop.h"
#include "app/digest/sha256.h"
#include "app/state/state_folder.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;

/// A file of the folder, also with the ending that editors of Windows add; empty: absent.
fs::path file_in(const fs::path& folder, const std::string& name) {
  std::error_code none;
  for (const char* ending : {"", ".txt"}) {
    const fs::path file = folder / (name + ending);
    if (fs::exists(file, none)) return file;
  }
  return {};
}

Result<std::vector<CameraAddress>> cameras_in(const fs::path& folder) {
  const fs::path file = file_in(folder, "cameras");
  if (file.empty()) return std::vector<CameraAddress>();
  const auto text = hal::read_regular_file(file);
  if (!text) return tl::unexpected(text.error());
  std::vector<CameraAddress> cameras;
  std::istringstream lines{std::string(without_mark(*text))};
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    const auto camera = camera_address(line);
    if (!camera) return fail(file.string() + ": " + camera.error().message);
    cameras.push_back(*camera);
  }
  return cameras;
}

fs::path passphrase_file(const fs::path& folder) { return file_in(folder, "passphrase"); }

/// Decrypts the secrets if there is a passphrase. False: there is none.
Result<bool> open_secrets_in(const fs::path& folder, ReadBackup& read) {
  if (read.backup.manifest.secrets != Secrets::Encrypted) return true;
  const fs::path file = passphrase_file(folder);
  if (file.empty()) return false;
  return hal::read_regular_file(file)
      .and_then([&](const std::string& text) { return open_secrets(read, passphrase_in(text)); })
      .map([] { return true; });
}

constexpr mode_t kOwnersFile = 0600;

/// Line that identifies an unchanged file without reading it: size, inode and time of its change.
Result<std::string> identity_of(const fs::path& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) {
    return fail(file.string() + ": cannot be read: " + std::system_category().message(errno));
  }
  std::ostringstream line;
  line << about.st_size << ' ' << about.st_ino << ' ' << about.st_mtim.tv_sec << '.'
       << about.st_mtim.tv_nsec << '\n';
  return line.str();
}

/// Line of a record: the secrets wait for their passphrase.
constexpr const char* kWithoutSecrets = "without secrets\n";

/// The backup of the folder.
struct BootBackup {
  fs::path folder;
  std::string hash;
  std::string identity;       ///< see identity_of()
  bool only_secrets = false;  ///< the rest was restored before, and may have changed since

  std::string record(bool has_secrets) const {
    return hash + "\n" + (has_secrets ? "" : kWithoutSecrets) + identity;
  }
};

/// Leaves only the secrets in a restoration.
void keep_secrets(const Manifest& manifest, Restoration& restoration) {
  std::erase_if(restoration.files, [&](const ArchivedFile& file) {
    return std::ranges::count(manifest.secret_files, file.name) == 0;
  });
  restoration.events.clear();
}

/// Restores a backup, and records it. Events that have no place do not keep the service from
/// starting.
Result<std::string> restored(const fs::path& config, const BootBackup& boot, FrameReader& frames) {
  auto read = read_backup(frames);
  if (!read) return tl::unexpected(read.error());
  const auto has_secrets = open_secrets_in(boot.folder, *read);
  if (!has_secrets) return tl::unexpected(has_secrets.error());
  const auto cameras = cameras_in(boot.folder);
  if (!cameras) return tl::unexpected(cameras.error());
  auto restoration = restoration_of(read->backup, config, *cameras);
  if (!restoration) return tl::unexpected(restoration.error());
  if (boot.only_secrets) keep_secrets(read->backup.manifest, *restoration);
  const auto reserved = exclude_daemon(config, restoration->places);
  if (!reserved) return tl::unexpected(reserved.error());
  DiskChanges disk;
  std::string text = restore_text(read->backup, *restoration);
  // Before the record: an interrupted restore is repeated, and goes on with the missing events.
  if (!restoration->events.empty()) {
    const auto placed = place_events(frames, restoration->events, restoration->event_place, disk);
    if (!placed) text += "not all events are restored: " + shown(placed.error().message) + "\n";
  }
  text += (boot.only_secrets ? "secrets restored from " : "restored from ") + boot.folder.string();
  if (!*has_secrets) {
    text += " without its secrets: put their passphrase into " +
            (boot.folder / "passphrase").string() + ", then systemctl restart " + unit_of(config);
  }
  const auto removed = boot.only_secrets ? std::vector<std::string>() : trial_names();
  return replace_files(restoration->places, restoration->files, disk, removed)
      .and_then([&] {
        return disk.write(boot_record(restoration->places), boot.record(*has_secrets), kOwnersFile);
      })
      .map([&] { return text + "\n"; });
}

}  // namespace

fs::path boot_record(const SitePlaces& places) { return places.state / "restored-from-boot"; }

Result<std::string> restore_from_boot(const fs::path& config, const fs::path& folder) {
  const fs::path file = folder / "restore.tar.zst";
  std::error_code none;
  if (folder.empty() || !fs::exists(file, none)) return std::string();
  const auto places = present_places(config);
  if (!places) return tl::unexpected(places.error());
  const auto identity = identity_of(file);
  if (!identity) return identity;
  const std::string before = hal::read_regular_file(boot_record(*places)).value_or("");
  const bool has_secrets = before.find(kWithoutSecrets) == before.npos;
  const bool is_complete = has_secrets || passphrase_file(folder).empty();
  if (is_complete && before.ends_with("\n" + *identity)) return std::string();
  const auto hash = sha256_of(file);
  if (!hash) return tl::unexpected(hash.error());
  const bool is_same = before.starts_with(*hash);
  const BootBackup boot{folder, *hash, *identity, is_same};
  if (is_complete && is_same) {
    return DiskChanges().write(boot_record(*places), boot.record(has_secrets), kOwnersFile).map([] {
      return std::string();
    });
  }
  auto frames = open_frames(file);
  if (!frames) return tl::unexpected(frames.error());
  auto done = restored(config, boot, *frames);
  if (!done) return fail(file.string() + ": " + shown(done.error().message));
  return done;
}

}  // namespace orbwatch::app::cli::backup
