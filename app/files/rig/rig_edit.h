// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/model/alignment/rig_alignment.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// The text of a rig file with the results of an alignment; comments, order and everything else are
/// kept; cameras that it does not place may be unplaced. `name` and `folder` as for parse_rig().
/// Errors: a rig that is refused before or after; no such camera; those of TomlEdit::finish().
Result<std::string> aligned_rig(const std::string& text, const std::string& name,
                                const std::filesystem::path& folder, const RigAlignment& alignment);

/// Writes the changed file to `out`, which may be the same one. Further errors: files that the rig
/// names and that do not exist relative to `out`, and those of hal::write_file().
Result<> write_aligned_rig(const std::filesystem::path& rig, const RigAlignment& alignment,
                           const std::filesystem::path& out);

}  // namespace orbwatch::app::files
