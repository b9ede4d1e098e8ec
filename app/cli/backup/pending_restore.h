// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/archive/archive.h"
#include "app/cli/backup/placement.h"
#include "app/cli/backup/site_places.h"
#include "proc/image/result.h"

/// Files that replace those of a site before orbwatchd starts the next time, for a daemon that
/// cannot replace them while it runs. They wait in kPendingRestore of the state folder, mode 0600.
/// Thread-bound.
namespace orbwatch::app::cli::backup {

std::filesystem::path pending_file(const SitePlaces& places);

/// Keeps files that replace_files() is to write, and names of those to be removed; of several calls
/// the last one counts. Errors: too many or too large; as the disk has them.
Result<> keep_pending(const SitePlaces& places, const Archive& files,
                      const std::vector<std::string>& removed, DiskChanges& disk);

/// Puts them in place. Returns false if there are none. No orbwatchd may run meanwhile. Errors: as
/// replace_files(); damaged. They are then dropped, unless the old files are not back yet.
Result<bool> place_pending(const SitePlaces& places, DiskChanges& disk);

/// Does so for the site `config`, after undo_interrupted(). Returns lines about what was done;
/// empty: nothing. Errors: orbwatchd runs; as place_pending().
Result<std::string> complete_pending(const std::filesystem::path& config);

}  // namespace orbwatch::app::cli::backup
