// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/files/text/text_file.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app::files {

/// Cameras with neither pose nor outline: an error, or allowed where cameras are placed.
enum class Unplaced { Refused, Allowed };

/// Reads and checks a rig file: every camera's projection can be made, except for unplaced cameras
/// that are allowed. Its keys are declared in rig_settings.h. Relative paths in it are based on the
/// file's folder. The error states file, line, key, reason and the allowed values.
Result<optics::Rig> load_rig(const std::filesystem::path& file, TextFiles& files);
Result<optics::Rig> load_rig(const std::filesystem::path& file,
                             Unplaced unplaced = Unplaced::Refused);

/// Parses text in place of a file named `name`, with paths relative to `folder`.
Result<optics::Rig> parse_rig(const std::string& text, const std::string& name,
                              const std::filesystem::path& folder,
                              Unplaced unplaced = Unplaced::Refused);

/// Manual of all keys in Markdown, generated from the declaration that the loader checks.
std::string rig_manual();

}  // namespace orbwatch::app::files
