// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// A picture that owns its pixels.
struct DecodedPicture {
  /// Grey, Y16, Rgb or Rgb16, of a recording any format; rows without padding.
  Picture picture;
  std::unique_ptr<std::byte[]> storage;
  bool is_flawed = false;  ///< see JpegDecoder::is_flawed()
  bool is_turned = false;  ///< EXIF orientation exchanged width and height
};

/// Addition to a message on a picture's size: "; its EXIF orientation turns its 640x480"; empty
/// unless EXIF exchanged width and height.
std::string exif_note(const DecodedPicture& decoded);

/// True for the file extensions of read_picture, regardless of case.
bool has_picture_name(const std::filesystem::path& path);

/// Decodes a JPEG or PNG file in memory. Grey stays grey and 16 bit stay 16 bit; alpha is dropped;
/// the orientation in EXIF is applied, see exif_orientation(). `name` is for messages. Errors:
/// another kind of file, truncated or damaged, a side above kMaxSide. Reentrant.
Result<DecodedPicture> decode_picture(std::span<const std::byte> file, std::string_view name);

/// Reads and decodes one file. Errors as decode_picture, and no such file or not readable.
/// Reentrant.
Result<DecodedPicture> read_picture(const std::filesystem::path& path);

}  // namespace orbwatch::hal
