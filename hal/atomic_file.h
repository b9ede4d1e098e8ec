// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Access to a file that write_file() makes. A replaced file keeps its mode, except under Owner.
enum class FileAccess {
  Umask,   ///< mode by the umask of the process
  Folder,  ///< writable by its owner, readable by users that may read its folder; ignores the
           ///< umask
  Owner    ///< accessible to its owner alone, mode 0600
};

/// Writes a file atomically: readers find the old one or the new one, also after a power cut, and a
/// failure leaves neither a part nor a temporary file. Written by root, the file belongs to the
/// owner of the file that it replaces, or, if that is root or does not exist, to the owner and the
/// group of its folder, so that a service can read it. Errors: folder missing or not writable, disk
/// full, a file system that refuses the owner, a device or another special file in the place.
/// Reentrant.
Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                    FileAccess access = FileAccess::Umask);
Result<> write_file(const std::filesystem::path& path, std::string_view text,
                    FileAccess access = FileAccess::Umask);

/// The same for a file that is written in parts: readers find the old one until it is placed. A
/// file that is not placed leaves nothing. Thread-bound.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::filesystem::path& path,
                                   FileAccess access = FileAccess::Umask);
  AtomicFile(AtomicFile&&) noexcept = default;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  Result<> write(std::string_view bytes);
  /// Ends the file, and replaces the one of this name.
  Result<> place();

 private:
  AtomicFile(std::filesystem::path path, std::filesystem::path temporary, FileDescriptor file);

  std::filesystem::path path_, temporary_;
  FileDescriptor file_;  ///< not open: placed, or moved from
};

/// Makes a changed or removed name in the folder survive a power cut. Error: the folder cannot be
/// read or written.
Result<> sync_folder(const std::filesystem::path& folder);

/// Removes the temporary files of write_file() that a power cut or a killed process left in a
/// folder; one that is being written stays. Error: the folder cannot be read or written.
Result<> remove_unfinished(const std::filesystem::path& folder);

}  // namespace orbwatch::hal
