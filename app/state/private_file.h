// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// Small files with secrets: mode 0600, replaced atomically, the same for orbwatchd and for
/// `orbwatch` run by root. All reentrant; they wait for the disk.
namespace orbwatch::app {

/// Returns the text; nullopt: there is no such file. Errors: not a regular file, accessible to
/// others, larger than 1 MiB, not readable.
Result<std::optional<std::string>> read_private(const std::filesystem::path& file);

/// Replaces the file: after a power cut it has the previous or the new text. A file written by root
/// belongs to the owner of its folder, which is created. Error: it cannot be written.
Result<> write_private(const std::filesystem::path& file, std::string_view text);

/// Runs `change` while no other process or thread does so for the same file. Errors: those of
/// `change`; the lock beside the file cannot be created.
Result<> with_lock(const std::filesystem::path& file, const std::function<Result<>()>& change);

}  // namespace orbwatch::app
