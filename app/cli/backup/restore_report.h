// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cli/backup/backup_file.h"
#include "app/cli/backup/restoration.h"

namespace orbwatch::app::cli::backup {

/// A text of a backup, which any computer may have written, for a terminal.
std::string shown(const std::string& text);

/// Lines about a backup and about what restoring it changes.
std::string restore_text(const Backup& backup, const Restoration& restoration);

/// The same as JSON, for the page: host, made, version, changes (file, change), not_restored,
/// left_out, cameras (name, key, address), notes.
std::string restore_json(const Backup& backup, const Restoration& restoration);

}  // namespace orbwatch::app::cli::backup
