#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Writes a whole file or nothing: readers see the old one or the new one, and a failure leaves
/// neither a part nor a temporary file. Errors: folder missing or not writable, disk full.
Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// Says why a picture of `format` could not be written to `path`, judging by the name alone: only
/// .png, .jpg and .jpeg are written, and JPEG has 8 bit and no transparency.
Result<> check_picture_name(const std::filesystem::path& path, PixelFormat format,
                            bool transparency);

/// Writes a Grey, Y16, Rgb or Rgb16 picture as PNG or JPEG by the name's ending. With `validity`
/// (the picture's size) pixels that are not Validity::Seen become transparent.
/// Errors: as write_file and check_picture_name.
Result<> write_picture(const std::filesystem::path& path, const Picture& picture,
                       const ImageView<const std::uint8_t>& validity = {});

}  // namespace orbwatch::app
