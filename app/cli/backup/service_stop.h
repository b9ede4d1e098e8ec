// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/backup/site_places.h"
#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// Keeps the orbwatchd of the site `config` from running until the descriptor is closed. Error: it
/// runs; the message states how to stop it.
Result<hal::FileDescriptor> exclude_daemon(const std::filesystem::path& config,
                                           const SitePlaces& places);

/// Puts the old files of the site `config` back if replace_files() was interrupted. Returns a line
/// about it; empty: it was not. Errors: orbwatchd runs; as undo_unfinished().
Result<std::string> undo_interrupted(const std::filesystem::path& config);

}  // namespace orbwatch::app::cli::backup
