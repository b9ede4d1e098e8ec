// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// The text without the byte order mark with which some editors begin a file.
std::string_view without_mark(std::string_view text);

/// The passphrase in the text of a file: its first line, without the end of the line.
std::string passphrase_in(std::string_view text);

/// The passphrase in `file`, or, if it is empty, what is typed on the terminal: twice for a new
/// passphrase. Errors: no terminal; too short or too long for a new one; the file cannot be read.
Result<std::string> new_passphrase(const std::filesystem::path& file);
Result<std::string> passphrase(const std::filesystem::path& file);

}  // namespace orbwatch::app::cli::backup
