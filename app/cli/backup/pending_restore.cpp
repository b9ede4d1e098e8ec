// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/pending_restore.h"

#include <cerrno>
#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/cli/archive/tar.h"
#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/restoration.h"
#include "app/cli/backup/service_stop.h"
#include "app/state/state_folder.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kOwner = 0600;
/// Entry with the names of files to be removed, each with a line's end.
constexpr const char* kRemoved = "removed";

struct Pending {
  Archive files;
  std::vector<std::string> removed;
};

Result<Pending> parse_pending(std::string_view tar) {
  auto archive = parse_tar(tar);
  if (!archive) return tl::unexpected(archive.error());
  if (archive->empty() || archive->front().name != kRemoved) return fail("is damaged");
  Pending pending;
  const std::string names = std::move(archive->front().bytes);
  archive->erase(archive->begin());
  pending.files = std::move(*archive);
  for (const ArchivedFile& file : pending.files) {
    if (auto placed = check_place(file.name); !placed) return tl::unexpected(placed.error());
  }
  for (std::size_t at = 0; at < names.size();) {
    const std::size_t end = std::min(names.find('\n', at), names.size());
    pending.removed.push_back(names.substr(at, end - at));
    if (auto placed = check_place(pending.removed.back()); !placed) {
      return tl::unexpected(placed.error());
    }
    at = end + 1;
  }
  return pending;
}

}  // namespace

fs::path pending_file(const SitePlaces& places) { return places.state / kPendingRestore; }

Result<> keep_pending(const SitePlaces& places, const Archive& files,
                      const std::vector<std::string>& removed, DiskChanges& disk) {
  Archive archive{{kRemoved, ""}};
  for (const std::string& name : removed) archive.front().bytes += name + "\n";
  archive.insert(archive.end(), files.begin(), files.end());
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return tar_of(archive, now).and_then([&](const std::string& tar) -> Result<> {
    const bool is_readable = tar.size() <= kMostBytes && archive.size() <= kMostArchivedFiles;
    if (!is_readable) return fail("the files are too many or too large to keep until the start");
    return disk.write(pending_file(places), tar, kOwner);
  });
}

Result<bool> place_pending(const SitePlaces& places, DiskChanges& disk) {
  const fs::path file = pending_file(places);
  const hal::FileDescriptor opened = hal::open_no_link(file);
  if (!opened.is_open() && errno == ENOENT) return false;
  if (!opened.is_open()) {
    return fail(file.string() + ": cannot be read: " + std::system_category().message(errno));
  }
  const auto placed = hal::read_regular_file(opened, file, kMostBytes)
                          .and_then([](const std::string& tar) { return parse_pending(tar); })
                          .and_then([&](const Pending& pending) {
                            return replace_files(places, pending.files, disk, pending.removed);
                          });
  std::error_code none;
  const bool is_undone = !fs::exists(undo_file(places), none);
  const auto dropped = placed || is_undone ? disk.remove(file) : Result<>();
  if (!placed) return fail(file.string() + ": " + placed.error().message);
  if (!dropped) return tl::unexpected(dropped.error());
  return true;
}

Result<std::string> complete_pending(const fs::path& config) {
  auto text = undo_interrupted(config);
  if (!text) return text;
  const auto places = present_places(config);
  if (!places) return tl::unexpected(places.error());
  std::error_code none;
  if (!fs::exists(fs::symlink_status(pending_file(*places), none))) return text;
  const auto reserved = exclude_daemon(config, *places);
  if (!reserved) return tl::unexpected(reserved.error());
  DiskChanges disk;
  const auto placed = place_pending(*places, disk);
  if (!placed) return tl::unexpected(placed.error());
  if (*placed) *text += "the files of a restore or reset that was asked for are in place\n";
  return text;
}

}  // namespace orbwatch::app::cli::backup
