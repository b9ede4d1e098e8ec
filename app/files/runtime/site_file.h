// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/files/resolve.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

inline constexpr const char* kDefaultSiteFile = "/etc/orbwatch/site.toml";

/// Path of the configuration file: `given` unless it is empty, else that of the environment's
/// ORBWATCH_CONFIG, else kDefaultSiteFile. Must not be called while the environment is changed.
std::filesystem::path site_file(const std::filesystem::path& given);

/// Keeps the texts of a configuration, and of its accepted alignments, in `folder`, replacing the
/// kept ones, each atomically.
/// Error: as hal::write_file().
Result<> keep_last_good(const std::filesystem::path& folder, const Resolved& site);

/// Resolves `file` with the kept texts in place of the files, and with the current accepted
/// alignments, or if these are damaged with the kept ones. Errors: none are kept for this file,
/// they are damaged, or as resolve().
Result<Resolved> resolve_last_good(const std::filesystem::path& folder,
                                   const std::filesystem::path& file);

}  // namespace orbwatch::app::files
