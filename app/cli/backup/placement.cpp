// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/placement.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <system_error>
#include <utility>

#include "app/cli/archive/tar.h"
#include "app/cli/backup/backup_file.h"
#include "hal/atomic_file.h"
#include "hal/made_folder.h"
#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kPermissions = 07777;
constexpr mode_t kOthers = 0077;  // permissions of others than the owner
/// Most bytes of the undo file.
constexpr std::size_t kMostKept = 2 * kMostBytes;
/// Entry of the undo file with the names of files that did not exist, each with a line's end.
constexpr const char* kAbsent = "absent";

tl::unexpected<Error> cannot(const fs::path& path, const std::string& what) {
  return fail(path.string() + ": cannot be " + what + ": " + std::system_category().message(errno));
}

/// Error: something that is not a folder, such as a link to one, is above the file.
Result<> check_folders(const SitePlaces& places, const std::string& name) {
  const fs::path& top = places.folder_of(name);
  fs::path folder = top;
  for (const fs::path& part : places.at(name).lexically_relative(top).parent_path()) {
    folder /= part;
    struct stat about {};
    if (::lstat(folder.c_str(), &about) != 0) {
      if (errno == ENOENT) return {};
      return cannot(folder, "read");
    }
    if (!S_ISDIR(about.st_mode)) return fail(folder.string() + ": is not a folder");
  }
  return {};
}

/// The file as it is; nullopt: there is none.
Result<std::optional<ArchivedFile>> present(const SitePlaces& places, const std::string& name) {
  if (auto right = check_folders(places, name); !right) return tl::unexpected(right.error());
  const fs::path file = places.at(name);
  const hal::FileDescriptor opened = hal::open_no_link(file);
  if (!opened.is_open()) {
    if (errno == ENOENT) return std::nullopt;
    if (errno == ELOOP) return fail(file.string() + ": is a link");
    return cannot(file, "read");
  }
  struct stat about {};
  if (::fstat(opened.get(), &about) != 0) return cannot(file, "read");
  auto bytes = hal::read_regular_file(opened, file, kMostBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return ArchivedFile{name, std::move(*bytes), about.st_mode & kPermissions};
}

/// Error: the folder of the file, or the one in which it is going to be made, cannot be written.
Result<> check_writable(const fs::path& file) {
  fs::path folder = file.parent_path();
  std::error_code none;
  while (!fs::exists(folder, none) && folder.has_relative_path()) folder = folder.parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  const std::string name = folder.string();
  return fail(
      name + ": its files cannot be replaced (" + std::system_category().message(errno) +
      "); run the command by sudo, or give the folder to the service: sudo chgrp orbwatch " + name +
      "; sudo chmod 2775 " + name);
}

/// Error: the file cannot become `wanted`, or, if that is nullopt, cannot be removed.
Result<> check_change(const SitePlaces& places, const std::string& name,
                      const std::optional<ArchivedFile>& wanted) {
  const auto old = present(places, name);
  if (!old) return tl::unexpected(old.error());
  return *old == wanted ? Result<>() : check_writable(places.at(name));
}

/// The files that are going to be replaced or removed, and the names of those that do not exist.
Result<Archive> kept_files(const SitePlaces& places, const std::vector<std::string>& names) {
  Archive kept{{kAbsent, ""}};
  for (const std::string& name : names) {
    auto old = present(places, name);
    if (!old) return tl::unexpected(old.error());
    if (*old) {
      kept.push_back(std::move(**old));
    } else {
      kept.front().bytes += name + "\n";
    }
  }
  return kept;
}

/// User of orbwatchd: the owner of its state folder, or, if root has made that before the first
/// start, the user of the unit.
uid_t user_of_service(const SitePlaces& places) {
  struct stat state {};
  if (::stat(places.state.c_str(), &state) == 0 && state.st_uid != 0) return state.st_uid;
  const struct passwd* const user = ::getpwnam("orbwatch");
  return user != nullptr ? user->pw_uid : 0;
}

/// Gives a file that only root could read to orbwatchd: the folders of the configuration, whose
/// owner a new file gets, belong to root.
Result<> give_to_service(const SitePlaces& places, const fs::path& file) {
  if (::geteuid() != 0) return {};
  const hal::FileDescriptor opened = hal::open_no_link(file);
  struct stat about {};
  if (!opened.is_open() || ::fstat(opened.get(), &about) != 0) return cannot(file, "read");
  if (about.st_uid != 0 || (about.st_mode & kOthers) != 0) return {};
  const bool is_given = ::fchown(opened.get(), user_of_service(places), about.st_gid) == 0 &&
                        ::fsync(opened.get()) == 0;
  if (!is_given) return cannot(file, "given to orbwatchd");
  return {};
}

/// Leaves the bytes of files that are right: their folder need not be writable.
Result<> write_files(const SitePlaces& places, const Archive& files, DiskChanges& disk) {
  for (const ArchivedFile& file : files) {
    if (auto right = check_folders(places, file.name); !right) return right;
    const fs::path path = places.at(file.name);
    const auto old = present(places, file.name);
    Result<> written;
    if (!old || *old != file) {
      written = make_folders(path.parent_path(), disk).and_then([&] {
        return disk.write(path, file.bytes, file.mode);
      });
    }
    if (written) written = give_to_service(places, path);
    if (!written) return written;
  }
  return {};
}

/// Removes a file, and folders that are empty without it. One above which nothing may be removed
/// stays: empty, it does no harm.
Result<> remove_file(const SitePlaces& places, const std::string& name, DiskChanges& disk) {
  if (auto right = check_folders(places, name); !right) return right;
  fs::path path = places.at(name);
  if (auto removed = disk.remove(path); !removed) return removed;
  const fs::path& top = places.folder_of(name);
  for (path = path.parent_path(); path != top; path = path.parent_path()) {
    std::error_code absent;
    const bool is_empty = fs::is_empty(path, absent);
    if (absent) continue;
    if (!is_empty || ::access(path.parent_path().c_str(), W_OK | X_OK) != 0) break;
    if (auto removed = disk.remove(path); !removed) return removed;
  }
  return {};
}

Result<> remove_files(const SitePlaces& places, const std::vector<std::string>& names,
                      DiskChanges& disk) {
  for (const std::string& name : names) {
    if (auto removed = remove_file(places, name, disk); !removed) return removed;
  }
  return {};
}

Result<> put_back(const SitePlaces& places, Archive kept, DiskChanges& disk) {
  if (kept.empty() || kept.front().name != kAbsent) return fail("is damaged");
  const std::string absent = std::move(kept.front().bytes);
  kept.erase(kept.begin());
  for (const ArchivedFile& file : kept) {
    if (auto placed = check_place(file.name); !placed) return placed;
  }
  if (auto written = write_files(places, kept, disk); !written) return written;
  for (std::size_t at = 0; at < absent.size();) {
    const std::size_t end = std::min(absent.find('\n', at), absent.size());
    const std::string name = absent.substr(at, end - at);
    auto removed = check_place(name).and_then([&] { return remove_file(places, name, disk); });
    if (!removed) return removed;
    at = end + 1;
  }
  return {};
}

}  // namespace

Result<> DiskChanges::write(const fs::path& file, std::string_view bytes, mode_t mode) {
  if (auto written = hal::write_file(file, bytes, hal::FileAccess::Owner); !written) return written;
  const hal::FileDescriptor opened(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  const bool is_set =
      opened.is_open() && ::fchmod(opened.get(), mode) == 0 && ::fsync(opened.get()) == 0;
  if (!is_set) return cannot(file, "given its mode");
  return {};
}

Result<> DiskChanges::remove(const fs::path& path) {
  std::error_code error;
  const bool was_there = fs::remove(path, error);
  if (error) return fail(path.string() + ": cannot be removed: " + error.message());
  if (!was_there) return {};
  return hal::sync_folder(path.parent_path());
}

Result<> DiskChanges::make_folder(const fs::path& folder) { return hal::make_folder(folder); }

Result<> make_folders(const fs::path& folder, DiskChanges& disk) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return {};
  if (auto made = make_folders(folder.parent_path(), disk); !made) return made;
  return disk.make_folder(folder);
}

Result<> check_replaceable(const SitePlaces& places, const Archive& files,
                           const std::vector<std::string>& removed) {
  for (const ArchivedFile& file : files) {
    if (auto right = check_change(places, file.name, file); !right) return right;
  }
  for (const std::string& name : removed) {
    if (auto right = check_change(places, name, std::nullopt); !right) return right;
  }
  return {};
}

fs::path undo_file(const SitePlaces& places) { return places.state / "restore-undo.tar"; }

Result<> replace_files(const SitePlaces& places, const Archive& files, DiskChanges& disk,
                       const std::vector<std::string>& removed) {
  if (auto right = check_replaceable(places, files, removed); !right) return right;
  std::vector<std::string> names = removed;
  for (const ArchivedFile& file : files) names.push_back(file.name);
  const auto kept = kept_files(places, names);
  if (!kept) return tl::unexpected(kept.error());
  const fs::path undo = undo_file(places);
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  constexpr mode_t kOwner = 0600;
  bool is_written = false;
  const auto done = tar_of(*kept, now)
                        .and_then([&](const std::string& tar) -> Result<> {
                          const bool is_readable =
                              tar.size() <= kMostKept && kept->size() <= kMostArchivedFiles;
                          if (!is_readable)
                            return fail("the old files are too many or too large to keep");
                          return make_folders(undo.parent_path(), disk).and_then([&] {
                            return disk.write(undo, tar, kOwner);
                          });
                        })
                        .and_then([&] { return write_files(places, files, disk); })
                        .and_then([&] { return remove_files(places, removed, disk); })
                        .and_then([&] {
                          is_written = true;
                          return disk.remove(undo);
                        });
  if (done) return {};
  const std::string& reason = done.error().message;
  const auto undone = undo_unfinished(places, disk);
  if (!undone) {
    return fail(reason + "; the old files are not back yet, because " + undone.error().message +
                "; repeat it by `orbwatch restore --undo`");
  }
  if (is_written && !*undone) return fail(reason + "; the new files are in place nevertheless");
  return fail(reason + "; nothing was changed");
}

Result<bool> undo_unfinished(const SitePlaces& places, DiskChanges& disk) {
  const fs::path undo = undo_file(places);
  const hal::FileDescriptor opened = hal::open_no_link(undo);
  if (!opened.is_open() && errno == ENOENT) return false;
  if (!opened.is_open()) return cannot(undo, "read");
  auto done = hal::read_regular_file(opened, undo, kMostKept)
                  .and_then([](const std::string& tar) { return parse_tar(tar); })
                  .and_then([&](Archive kept) { return put_back(places, std::move(kept), disk); })
                  .and_then([&] { return disk.remove(undo); });
  if (!done) return fail(undo.string() + ": " + done.error().message);
  return true;
}

}  // namespace orbwatch::app::cli::backup
