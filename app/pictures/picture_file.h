#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Writes a file atomically: readers find the old one or the new one, and a failure leaves neither
/// a part nor a temporary file. Errors: folder missing or not writable, disk full.
Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
Result<> write_file(const std::filesystem::path& path, std::string_view text);

/// Removes the temporary files of write_file() that a power cut or a killed process left in a
/// folder; one that is being written stays. Error: the folder cannot be read or written.
Result<> remove_unfinished(const std::filesystem::path& folder);

/// Checks by the name alone whether a picture of `format` can be written to `path`. Errors: not
/// .png, .jpg or .jpeg; 16 bit or transparency as JPEG.
Result<> check_picture_name(const std::filesystem::path& path, PixelFormat format,
                            bool transparency);

/// Writes a Grey, Y16, Rgb or Rgb16 picture as PNG or JPEG, by the extension. With `validity`, of
/// the picture's size, pixels that are not Validity::Seen become transparent.
/// Errors: as write_file and check_picture_name.
Result<> write_picture(const std::filesystem::path& path, const Picture& picture,
                       const ImageView<const std::uint8_t>& validity = {});

}  // namespace orbwatch::app
