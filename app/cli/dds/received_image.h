// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "app/ports/dds/pictures/image_message.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// A received image is refused when its width or height is above this.
inline constexpr std::uint32_t kMaxImageSide = 16384;

/// Consistent received image. Its bytes belong to the message that it was made from.
struct ReceivedImage {
  dds::ImageEncoding encoding = dds::kRgb8;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::size_t step = 0;  ///< bytes from row to row
  const std::uint8_t* data = nullptr;
  bool swapped = false;  ///< 16-bit samples have the byte order opposite to the host's
};

/// Checks a message from the network before any pixel is read. Errors: unknown encoding, a side
/// of 0 or beyond kMaxImageSide, rows longer than the step, a step that is not a multiple of the
/// sample's size, data of another size than step * height. Reentrant.
Result<ReceivedImage> check_image(const dds::ImageMessage& message);
/// Checks only the sides, in pixels.
Result<> check_image_size(std::uint32_t width, std::uint32_t height);

/// Writes the image as PNG, 16 bit kept, and replaces an existing `path`: readers see the old file
/// or the new one. Errors: folder missing or not writable, disk full.
Result<> save_png(const ReceivedImage& image, const std::filesystem::path& path);

/// Writes a JPEG picture, whose sides passed check_image_size(), as PNG. Its pixels stay where they
/// are, as in viewers of its topic: an orientation in EXIF is ignored. Further errors: another kind
/// of picture, damaged.
Result<> save_jpeg_as_png(std::span<const std::uint8_t> jpeg, const std::filesystem::path& path);

}  // namespace orbwatch::app::cli
