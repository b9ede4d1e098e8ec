// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "app/ports/recorder/export/export_file.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Writes baseline TIFF 6.0 with a page for each picture: little-endian, uncompressed, one strip.
/// Thread-bound; waits for the disk.
class TiffWriter {
 public:
  /// True for luminance and R G B, whose samples TIFF has as they are.
  static bool can_write(PixelFormat format);

  static Result<TiffWriter> create(const std::filesystem::path& path);

  /// Appends a page. `picture` has no padding and a format that can_write() permits; `description`
  /// is ASCII. Errors: of the disk; the file would exceed 4 GiB, which TIFF cannot have.
  Result<> add(const Picture& picture, const std::string& description);
  /// Makes the file survive a power cut.
  Result<> finish() { return file_.sync(); }

 private:
  explicit TiffWriter(ExportFile file) : file_(std::move(file)) {}

  ExportFile file_;
  std::uint64_t link_ = 0;  ///< place of the offset of the next page
};

}  // namespace orbwatch::app::recorder
