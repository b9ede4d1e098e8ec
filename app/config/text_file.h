#pragma once

#include <filesystem>
#include <string>

#include "proc/image/result.h"

namespace orbwatch::app {

/// A whole file that people write. `kind` names for the error what it must be, as in "a TOML file".
/// Errors: it cannot be read, or it is larger than 1 MiB, which no such file is.
Result<std::string> read_text_file(const std::filesystem::path& file, const std::string& kind);

}  // namespace orbwatch::app
