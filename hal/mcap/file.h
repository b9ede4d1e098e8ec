// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "hal/mcap/file_result.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal::mcap {

/// An open regular file, read and written at given offsets. Errors name the file. Thread-bound.
class File {
 public:
  enum class Access {
    Read,    ///< reads a file that another process may be writing
    Change,  ///< changes a file that no other process changes
    Create   ///< makes a new file
  };

  /// Errors: missing; present, for Create; not a regular file; being written, for Change.
  static FileResult<File> open(const std::filesystem::path& path, Access access);
  /// `name` stands in errors.
  File(FileDescriptor opened, std::string name)
      : descriptor_(std::move(opened)), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  FileResult<std::uint64_t> size() const;

  /// Fills `into`. Error: the file ends before.
  FileResult<> read(std::uint64_t offset, std::span<std::byte> into) const;
  /// Writes the parts one after another. An error leaves any number of their bytes in the file.
  FileResult<> write(std::uint64_t offset,
                     std::initializer_list<std::span<const std::byte>> parts) const;
  FileResult<> truncate(std::uint64_t size) const;
  /// Replaces everything from `offset` on, for good: a power cut leaves any part of the new bytes.
  /// An error leaves none, if the disk permits.
  FileResult<> replace_end(std::uint64_t offset, std::span<const std::byte> bytes) const;
  /// Makes written data and the size survive a power cut.
  FileResult<> sync() const;

  /// The same error with the file's name in front.
  tl::unexpected<FileError> named(const FileError& error) const;

 private:
  tl::unexpected<FileError> failed_now(const std::string& what) const;

  FileDescriptor descriptor_;
  std::string name_;
};

}  // namespace orbwatch::hal::mcap
