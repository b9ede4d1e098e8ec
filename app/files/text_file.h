#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Texts by the path of their file.
using FileTexts = std::map<std::filesystem::path, std::string>;

/// Bytes of a file that holds all texts of a configuration: site, rig, lenses and recipes, of which
/// each has 1 MiB at most.
inline constexpr std::size_t kMostTexts = std::size_t{64} << 20;

/// Reads hand-written files, at most 1 MiB each, and keeps a CRC-32 of all that was read, in order.
class TextFiles {
 public:
  /// A file that is among `instead` is not read: that is its text.
  explicit TextFiles(FileTexts instead = {}) : instead_(std::move(instead)) {}

  /// `kind` names for the error what the file must be, as in "a TOML file". Errors: as
  /// hal::read_regular_file().
  Result<std::string> read(const std::filesystem::path& file, const std::string& kind);

  /// A text that stands in for a file.
  void add(const std::string& text);

  std::uint32_t checksum() const { return checksum_; }

  /// What was read.
  const FileTexts& texts() const { return texts_; }
  const FileTexts& instead() const { return instead_; }

 private:
  FileTexts instead_;
  FileTexts texts_;
  std::uint32_t checksum_ = 0;
};

}  // namespace orbwatch::app
