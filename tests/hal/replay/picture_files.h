// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

inline std::vector<std::byte> file_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

inline void write_file(const std::filesystem::path& path, const std::vector<std::byte>& bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  ASSERT_TRUE(stream.good()) << path;
}

/// Keeps the first part of a file, like a recorder after a power cut.
inline void truncate_file(const std::filesystem::path& path, double part) {
  auto bytes = file_bytes(path);
  bytes.resize(static_cast<std::size_t>(static_cast<double>(bytes.size()) * part));
  write_file(path, bytes);
}

}  // namespace orbwatch::tests
