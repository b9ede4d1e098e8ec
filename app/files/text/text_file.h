// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "proc/image/result.h"

namespace orbwatch::app::files {

/// Texts by the path of their file.
using FileTexts = std::map<std::filesystem::path, std::string>;

/// Limit in bytes for a file with all texts of a configuration: site, rig, lenses and recipes, each
/// at most 1 MiB.
inline constexpr std::size_t kMostTexts = std::size_t{64} << 20;

/// CRC-32 of a text, as it is kept in the state folder and shown to clients; with `before`, of both
/// texts, one after the other. Reentrant.
std::uint32_t checksum_of(const std::string& text, std::uint32_t before = 0);

/// Reads hand-written files, at most 1 MiB each, and keeps a CRC-32 of all texts read, in order.
class TextFiles {
 public:
  /// A file in `instead` is not read; its text there is used.
  explicit TextFiles(FileTexts instead = {}) : instead_(std::move(instead)) {}

  /// `kind` is the required kind of the file for the error, such as "a TOML file". Errors: as
  /// hal::read_regular_file().
  Result<std::string> read(const std::filesystem::path& file, const std::string& kind);

  /// Adds a text in place of a file.
  void add(const std::string& text) { checksum_ = checksum_of(text, checksum_); }

  std::uint32_t checksum() const { return checksum_; }

  /// Texts that were read.
  const FileTexts& texts() const { return texts_; }
  const FileTexts& instead() const { return instead_; }

 private:
  FileTexts instead_;
  FileTexts texts_;
  std::uint32_t checksum_ = 0;
};

}  // namespace orbwatch::app::files
