#pragma once

#include <filesystem>

#include "app/files/resolve.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// The configuration file: `given` unless it is empty, else that of the environment's
/// ORBWATCH_CONFIG, else /etc/orbwatch/site.toml. Not while the environment is changed.
std::filesystem::path site_file(const std::filesystem::path& given);

/// Keeps the texts of a configuration, and of its accepted alignments, in `folder`, replacing those
/// that were kept, each atomically.
/// Error: as hal::write_file().
Result<> keep_last_good(const std::filesystem::path& folder, const Resolved& site);

/// Resolves `file` with the kept texts in place of the files, and with the accepted alignments as
/// they are now, or if these are damaged with those that were kept. Errors: none are kept for this
/// file, they are damaged, or as resolve().
Result<Resolved> resolve_last_good(const std::filesystem::path& folder,
                                   const std::filesystem::path& file);

}  // namespace orbwatch::app
