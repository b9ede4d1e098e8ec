// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// One value of fixed size in a file that is locked while it is open. The file has two slots, each
/// with a number and a checksum; the valid one with the higher number counts. A write goes to the
/// other one, so that a power cut at any moment leaves the previous or the new value. The file is
/// allocated when it is created: no write needs further disk space. Thread-bound.
class SlotFile {
 public:
  static constexpr std::size_t kSlotSize = 8192;
  static constexpr std::size_t kFileSize = 2 * kSlotSize;
  /// Version of the slots' format and content.
  static constexpr std::uint32_t kVersion = 1;

  struct Header {
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    std::uint32_t checksum = 0;  ///< CRC-32 of number and content
    std::uint64_t number = 0;
  };
  using Content = std::array<std::byte, kSlotSize - sizeof(Header)>;

  /// Opens `file`; an absent one is created, with its folder, and holds zeros. Errors: folder or
  /// file cannot be created, read or written, or another process has the folder open.
  static Result<std::unique_ptr<SlotFile>> open(const std::filesystem::path& file);

  /// The newest valid value. Error: both slots are damaged, or of another version.
  const Result<Content>& content() const { return content_; }

  /// Writes the value; it is on the disk on return. Error: it may be written or not; the previous
  /// value is kept.
  Result<> write(const Content& content);

 private:
  struct Slot {
    Header header;
    Content content;
  };
  static_assert(sizeof(Slot) == kSlotSize);

  explicit SlotFile(std::filesystem::path path) : path_(std::move(path)) {}

  Result<> lock();
  Result<> create() const;
  Result<> load();
  Error error(const std::string& what) const;

  std::filesystem::path path_;
  hal::FileDescriptor folder_;  ///< locked against a second daemon
  hal::FileDescriptor file_;
  Result<Content> content_;
  std::uint64_t number_ = 0;  ///< number of the newest valid slot
  std::size_t next_ = 0;      ///< index of the slot for the next write
};

}  // namespace orbwatch::app
