#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Reads hand-written files, at most 1 MiB each, and keeps a CRC-32 of all that was read, in order.
class TextFiles {
 public:
  /// `kind` names for the error what the file must be, as in "a TOML file". Errors: it cannot be
  /// read, or is larger than 1 MiB.
  Result<std::string> read(const std::filesystem::path& file, const std::string& kind);

  /// A text that stands in for a file.
  void add(const std::string& text);

  std::uint32_t checksum() const { return checksum_; }

 private:
  std::uint32_t checksum_ = 0;
};

}  // namespace orbwatch::app
