#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// Writes a file atomically: readers find the old one or the new one, also after a power cut, and a
/// failure leaves neither a part nor a temporary file. It keeps its mode. Errors: folder missing or
/// not writable, disk full. Reentrant.
Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
Result<> write_file(const std::filesystem::path& path, std::string_view text);

/// A name in the folder that was changed or removed stays so after a power cut. Error: the folder
/// cannot be read or written.
Result<> sync_folder(const std::filesystem::path& folder);

/// Removes the temporary files of write_file() that a power cut or a killed process left in a
/// folder; one that is being written stays. Error: the folder cannot be read or written.
Result<> remove_unfinished(const std::filesystem::path& folder);

}  // namespace orbwatch::hal
