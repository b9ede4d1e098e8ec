#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// Small files with secrets: mode 0600, replaced whole, the same for orbwatchd and for root who
/// runs `orbwatch`. All reentrant; they wait for the disk.
namespace orbwatch::app {

/// The text, nullopt when there is no such file. Errors: it is no regular file, others may read or
/// write it, it is larger than 1 MiB, it cannot be read.
Result<std::optional<std::string>> read_private(const std::filesystem::path& file);

/// Replaces the file: after a power cut it is the one before or the new one. Written by root it
/// belongs to the owner of its folder, which is created. Error: it cannot be written.
Result<> write_private(const std::filesystem::path& file, std::string_view text);

/// Runs `change` while no other process or thread does so for the same file. Errors: those of
/// `change`; the lock beside the file cannot be created.
Result<> with_lock(const std::filesystem::path& file, const std::function<Result<>()>& change);

}  // namespace orbwatch::app
