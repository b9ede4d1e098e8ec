// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "hal/mcap/file.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// A new file that bytes are appended to. Errors name it. Thread-bound; waits for the disk.
class ExportFile {
 public:
  /// Error: there is one; the folder is not writable.
  static Result<ExportFile> create(const std::filesystem::path& path);

  Result<> append(std::span<const std::byte> bytes);
  Result<> append(std::string_view text) { return append(std::as_bytes(std::span(text))); }
  /// Replaces bytes that were appended.
  Result<> replace(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Makes the content survive a power cut.
  Result<> sync() const;

  std::uint64_t size() const { return size_; }

 private:
  explicit ExportFile(hal::mcap::File file) : file_(std::move(file)) {}

  hal::mcap::File file_;
  std::uint64_t size_ = 0;
};

}  // namespace orbwatch::app::recorder
