// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

#include "app/ports/recorder/export/export_file.h"
#include "hal/mcap/fields.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Facts about the pictures of a video.
struct AviFormat {
  int width = 0, height = 0;
  std::chrono::microseconds period{0};  ///< from picture to picture
};

/// Writes a video of JPEG pictures (MJPEG) as AVI 1.0 with an index. Thread-bound; waits for the
/// disk.
class AviWriter {
 public:
  static Result<AviWriter> create(const std::filesystem::path& path, const AviFormat& format);

  /// Appends a picture of the format's size. Errors: of the disk; the file would exceed 2 GiB,
  /// which readers of AVI 1.0 do not expect.
  Result<> add(std::span<const std::byte> jpeg);
  /// Writes index and header, and makes the file survive a power cut.
  Result<> finish();

 private:
  AviWriter(ExportFile file, const AviFormat& format) : file_(std::move(file)), format_(format) {}

  /// Everything in front of the first picture, with the sizes of what follows: all of the file, and
  /// the list of pictures.
  hal::mcap::Bytes header(std::uint64_t file, std::uint64_t movie) const;

  ExportFile file_;
  AviFormat format_;
  std::uint64_t movie_ = 0;  ///< place of the list of pictures
  hal::mcap::Bytes index_;
  std::uint32_t pictures_ = 0, largest_ = 0;  ///< their number, bytes of the largest
};

}  // namespace orbwatch::app::recorder
