// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include "hal/mcap/fields.h"
#include "hal/thread/file_descriptor.h"
#include "tests/support/require.h"

namespace orbwatch::tests {

inline hal::mcap::Bytes bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// A file without a disk, for thousands of versions of a recording.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("recording", MFD_CLOEXEC)) { require(file_.is_open()); }

  /// Opens the file anew each time.
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_.get()); }

  void set(std::span<const std::byte> bytes) const {
    require(::ftruncate(file_.get(), 0) == 0);
    require(::pwrite(file_.get(), bytes.data(), bytes.size(), 0) ==
            static_cast<ssize_t>(bytes.size()));
  }

 private:
  hal::FileDescriptor file_;
};

}  // namespace orbwatch::tests
