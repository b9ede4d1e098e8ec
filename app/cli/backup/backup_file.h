// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/cli/archive/archive.h"
#include "app/cli/archive/frame_stream.h"
#include "app/cli/backup/manifest.h"
#include "proc/image/result.h"

/// A backup as a file: tar.zst with manifest.json, the files that are not secret, and
/// secrets.sealed, an encrypted tar of the others. Kept events follow in a frame of their own, see
/// events/kept_events.h. All reentrant.
namespace orbwatch::app::cli::backup {

/// Largest backup that is read, unpacked, without its events.
inline constexpr std::size_t kMostBytes = std::size_t{128} << 20;

/// Files of a site. The manifest's lists of files and secret files follow from them.
struct Backup {
  Manifest manifest;
  Archive files;    ///< names are those of check_backed_up()
  Archive secrets;  ///< empty after read_backup(): see open_secrets()
};

/// The bytes of a backup, without its events, with encrypted secrets, or without them if the
/// passphrase is empty. Errors: a name that does not fit; more than kMostBytes; out of memory.
Result<std::string> backup_bytes(Backup backup, std::string_view passphrase);

/// A backup as it was read.
struct ReadBackup {
  Backup backup;
  std::string manifest_text;
  std::string sealed;
};

/// Opens a file of any origin. Errors: not a regular file, not readable.
Result<FrameReader> open_frames(const std::filesystem::path& file);

/// Reads and checks the first frame of any origin; the events may follow. Errors: damaged, larger
/// than kMostBytes, a newer format, a file that is missing, added or changed, a name outside of the
/// places of a site; something follows although there are no events.
Result<ReadBackup> read_backup(FrameReader& frames);
/// The same for the unpacked tar.
Result<ReadBackup> parse_backup_tar(std::string_view tar);

/// Decrypts the secrets, also those that a former version sealed with the byte order mark of a
/// passphrase file. Errors: a wrong passphrase, changed bytes; as read_backup().
Result<> open_secrets(ReadBackup& read, std::string_view passphrase);

}  // namespace orbwatch::app::cli::backup
