// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "app/cli/archive/archive.h"
#include "app/cli/backup/manifest.h"
#include "proc/image/result.h"

/// A backup as a file: tar.zst with manifest.json, the files that are not secret, and
/// secrets.sealed, an encrypted tar of the others. All reentrant.
namespace orbwatch::app::cli::backup {

/// Largest backup that is read, unpacked.
inline constexpr std::size_t kMostBytes = std::size_t{128} << 20;

/// Files of a site. The manifest's lists of files and secret files follow from them.
struct Backup {
  Manifest manifest;
  Archive files;    ///< names are those of check_backed_up()
  Archive secrets;  ///< empty after parse_backup(): see open_secrets()
};

/// The bytes of a backup with encrypted secrets, or without them if the passphrase is empty.
/// Errors: a name that does not fit; out of memory.
Result<std::string> backup_bytes(Backup backup, std::string_view passphrase);

/// A backup as it was read.
struct ReadBackup {
  Backup backup;
  std::string manifest_text;
  std::string sealed;
};

/// Checks bytes of any origin. Errors: damaged, larger than kMostBytes, a newer format, a file that
/// is missing, added or changed, a name outside of the places of a site.
Result<ReadBackup> parse_backup(std::string_view bytes);
/// The same for the unpacked tar.
Result<ReadBackup> parse_backup_tar(std::string_view tar);

/// Decrypts the secrets. Errors: a wrong passphrase, changed bytes; as parse_backup().
Result<> open_secrets(ReadBackup& read, std::string_view passphrase);

}  // namespace orbwatch::app::cli::backup
