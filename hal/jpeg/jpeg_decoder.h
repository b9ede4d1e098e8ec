// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Size from the header of a JPEG picture, before its EXIF orientation is applied.
struct JpegSize {
  int width = 0;
  int height = 0;
  bool is_grey = false;  ///< has luminance only
};

class JpegReader;

/// Decodes with libjpeg-turbo in strict mode: data that it would repair (a truncated file, a broken
/// code, bytes lost on USB) is an error here, because a repaired picture must not be measured.
/// Padding before a marker, a missing end marker, and other data in its place, which many USB
/// cameras send, are not errors. Reads grey and YCbCr pictures, baseline and progressive, also
/// without the standard Huffman tables, which USB cameras omit. Thread-bound and reusable.
class JpegDecoder {
 public:
  JpegDecoder();
  ~JpegDecoder();

  /// True if the picture checked or decoded last had such padding, or no end marker: see
  /// JpegReader::is_flawed().
  bool is_flawed() const;
  /// Bytes of the picture checked or decoded last: see JpegReader::picture_bytes().
  std::size_t picture_bytes() const;

  /// Errors: not a JPEG picture, header damaged, CMYK.
  Result<JpegSize> read_size(std::span<const std::byte> jpeg);

  /// Reads all compressed data without decoding at full size. Errors as read_size, and damaged
  /// data.
  Result<> check(std::span<const std::byte> jpeg);

  /// Decodes into `target` of 8 bit: the luminance only with 1 channel, R'G'B' with 3. Errors as
  /// check, and another size than target's; target's pixels are then undefined.
  Result<> decode_packed(std::span<const std::byte> jpeg, const ImageView<std::uint8_t>& target);

  /// Decodes into `target`, Nv12, BT.601 of full range, without conversion to RGB. Finer chroma is
  /// averaged; grey pictures get neutral chroma. Errors as decode_packed, an RGB picture, and
  /// chroma for other than 1, 2 or 4 columns and 1 or 2 rows.
  Result<> decode_nv12(std::span<const std::byte> jpeg, const MutablePicture& target);

 private:
  Result<> open(int width, int height, std::span<const std::byte> jpeg);
  Result<> read_strips(const MutablePicture& target);
  void prepare_strips();
  ImageView<const std::uint8_t> strip(std::size_t number, int height) const;
  void write_strip(int y, int count, const MutablePicture& target) const;

  std::unique_ptr<JpegReader> reader_;
  std::vector<std::uint8_t> thumbnail_;  ///< target of check()
  /// One row of MCUs of Y, U and V in the file's resolution, and the start of each row.
  std::array<std::vector<std::uint8_t>, 3> strips_;
  std::array<std::vector<std::uint8_t*>, 3> rows_;
};

}  // namespace orbwatch::hal
