// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// The first line of `file`, or, if it is empty, what is typed on the terminal: twice for a new
/// passphrase. Errors: no terminal; too short or too long for a new one; the file cannot be read.
Result<std::string> new_passphrase(const std::filesystem::path& file);
Result<std::string> passphrase(const std::filesystem::path& file);

}  // namespace orbwatch::app::cli::backup
