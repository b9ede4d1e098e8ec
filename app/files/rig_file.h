#pragma once

#include <filesystem>
#include <string>

#include "app/files/text_file.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Reads and checks a rig file: every camera's projection can be made. Its keys stand in
/// rig_settings.h. Relative paths in it count from the file's folder. The error says file, line,
/// key, what is wrong and what is allowed.
Result<optics::Rig> load_rig(const std::filesystem::path& file, TextFiles& files);
Result<optics::Rig> load_rig(const std::filesystem::path& file);

/// The same for text that stands in for a file named `name`, with paths relative to `folder`.
Result<optics::Rig> parse_rig(const std::string& text, const std::string& name,
                              const std::filesystem::path& folder);

/// The manual of all keys in Markdown, generated from the same declaration that the loader checks.
std::string rig_manual();

}  // namespace orbwatch::app
