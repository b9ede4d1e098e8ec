// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/archive/archive.h"
#include "app/cli/backup/site_places.h"
#include "proc/image/result.h"

/// Replaces many files so that a failure or a power cut at any moment leaves all old or all new
/// ones. The old ones are kept in restore-undo.tar of the state folder, mode 0600, until all new
/// ones are on the disk:
///
///     keep the old ones --> write the new ones --> remove restore-undo.tar: the new ones count
///                                  | failure, or the next start
///                                  v
///                           put the old ones back
///
/// No orbwatchd may run meanwhile. Thread-bound.
namespace orbwatch::app::cli::backup {

/// Changes of the disk; tests let them fail. Each is on the disk when it returns.
class DiskChanges {
 public:
  DiskChanges() = default;
  DiskChanges(const DiskChanges&) = delete;
  DiskChanges& operator=(const DiskChanges&) = delete;
  virtual ~DiskChanges() = default;

  /// Replaces a file atomically; its owner is that of hal::write_file().
  virtual Result<> write(const std::filesystem::path& file, std::string_view bytes, mode_t mode);
  /// Removes a file, or an empty folder; an absent one is no error.
  virtual Result<> remove(const std::filesystem::path& path);
  /// Makes a folder with owner and mode of the one that contains it.
  virtual Result<> make_folder(const std::filesystem::path& folder);
};

/// Makes a folder and the missing ones above it.
Result<> make_folders(const std::filesystem::path& folder, DiskChanges& disk);

/// Checks what replace_files() is going to do, without doing it. Errors: a link or a folder is in
/// the way of a file; a folder of one that would change cannot be written by this user.
Result<> check_replaceable(const SitePlaces& places, const Archive& files,
                           const std::vector<std::string>& removed = {});

std::filesystem::path undo_file(const SitePlaces& places);

/// Writes the files that differ, and removes those named `removed`; names are those of
/// check_place(). Written by root, a file that only its owner may read belongs to the user of
/// orbwatchd, not to root. Errors: as check_replaceable(), and as the disk has them; nothing is
/// changed then, unless the message says that undo_unfinished() must be repeated.
Result<> replace_files(const SitePlaces& places, const Archive& files, DiskChanges& disk,
                       const std::vector<std::string>& removed = {});

/// Puts the old files back after an interruption of replace_files(). Returns false if there was
/// none. Errors: as the disk has them; it may be repeated.
Result<bool> undo_unfinished(const SitePlaces& places, DiskChanges& disk);

}  // namespace orbwatch::app::cli::backup
