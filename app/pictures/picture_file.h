// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Checks only by the name whether a picture of `format` can be written to `path`. Errors: not
/// .png, .jpg or .jpeg; 16 bit or transparency as JPEG.
Result<> check_picture_name(const std::filesystem::path& path, PixelFormat format,
                            bool transparency);

/// Writes a Grey, Y16, Rgb or Rgb16 picture as PNG or JPEG, by the extension. With `validity`, of
/// the picture's size, pixels that are not Validity::Seen become transparent. Errors: those of
/// hal::write_file() and check_picture_name().
Result<> write_picture(const std::filesystem::path& path, const Picture& picture,
                       const ImageView<const std::uint8_t>& validity = {});

}  // namespace orbwatch::app
