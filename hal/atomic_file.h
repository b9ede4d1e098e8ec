#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// Access to a file that write_file() makes. A file that it replaces keeps its mode, but for
/// Owner.
enum class FileAccess {
  Umask,   ///< as the umask of the process has it
  Folder,  ///< its owner, and to read whoever may read its folder, whatever the umask
  Owner    ///< its owner alone, mode 0600
};

/// Writes a file atomically: readers find the old one or the new one, also after a power cut, and a
/// failure leaves neither a part nor a temporary file. Written by root it belongs to the owner of
/// the file that it replaces, or, where that is root or there is none, to the owner and the group
/// of its folder: a service reads what root writes for it. Errors: folder missing or not writable,
/// disk full, a file system that refuses the owner. Reentrant.
Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                    FileAccess access = FileAccess::Umask);
Result<> write_file(const std::filesystem::path& path, std::string_view text,
                    FileAccess access = FileAccess::Umask);

/// A name in the folder that was changed or removed stays so after a power cut. Error: the folder
/// cannot be read or written.
Result<> sync_folder(const std::filesystem::path& folder);

/// Removes the temporary files of write_file() that a power cut or a killed process left in a
/// folder; one that is being written stays. Error: the folder cannot be read or written.
Result<> remove_unfinished(const std::filesystem::path& folder);

}  // namespace orbwatch::hal
