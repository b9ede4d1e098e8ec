// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "app/cli/archive/archive.h"
#include "proc/image/result.h"

/// Archives of regular files in the format ustar of POSIX.1-1988, which every tar reads. All
/// reentrant.
namespace orbwatch::app::cli {

/// Most files that are read from one archive.
inline constexpr std::size_t kMostArchivedFiles = 4096;

/// The archive's bytes; its files have the modification time `made` and owner 0. Error: a name is
/// not right, or does not fit into the format.
Result<std::string> tar_of(const Archive& archive, std::chrono::sys_seconds made);

/// The files of an archive of any origin; owners and times are ignored. Errors: damaged or cut off;
/// an entry that is not a regular file, such as a link or a device; a name that is not right or
/// occurs twice; more than kMostArchivedFiles.
Result<Archive> parse_tar(std::string_view bytes);

}  // namespace orbwatch::app::cli
