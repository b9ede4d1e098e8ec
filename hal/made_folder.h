// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// Makes a folder with owner and mode of the one that contains it, but without set-user-ID and
/// sticky bit; its name survives a power cut. A service may make one, and root makes one for it.
/// Errors: it exists; another program put something else in its place; as the disk has them.
/// Reentrant.
Result<> make_folder(const std::filesystem::path& folder);

/// Makes the missing folders above a file. Errors: as make_folder(). Reentrant.
Result<> make_folders_above(const std::filesystem::path& file);

}  // namespace orbwatch::hal
