// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/backup/site_places.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// Environment variable with the folder of restore_from_boot(); not set or empty: there is none.
inline constexpr const char* kBootFolder = "ORBWATCH_RESTORE_FOLDER";

/// Record of the backup that was restored last from there: its checksum, a line "without secrets"
/// if these wait for their passphrase, then size, inode and time of its file.
std::filesystem::path boot_record(const SitePlaces& places);

/// Restores the backup that a folder of the boot partition has, which any computer can write: so a
/// replacement takes over without a login. Its files are
///
///     restore.tar.zst   the backup
///     passphrase        of its secrets, in the first line; absent: they are not restored yet
///     cameras           lines NAME=ADDRESS: cameras that are other devices here; may be absent
///
/// The last two may also end in .txt and begin with a byte order mark, as editors of Windows write
/// them. A passphrase that arrives after the rest was restored restores the secrets alone.
///
/// The same backup is restored once: restored-from-boot of the state folder has its checksum. A
/// file that has not changed since is not read again. Returns lines about it; empty: nothing was
/// done. Errors: orbwatchd runs; as read_backup(), restoration_of() and replace_files().
/// Thread-bound.
Result<std::string> restore_from_boot(const std::filesystem::path& config,
                                      const std::filesystem::path& folder);

}  // namespace orbwatch::app::cli::backup
