// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Header of a PNG picture: its size, and the format in which it is decoded.
struct PngHeader {
  PixelFormat format = PixelFormat::Grey;  ///< Grey, Y16, Rgb or Rgb16
  int width = 0;
  int height = 0;
};

/// True when `file` starts with the signature of PNG.
bool is_png(std::span<const std::byte> file);

class PngReader;

/// Decodes with libpng in strict mode: a wrong check sum of any chunk (ISO/IEC 15948, 5.3) and
/// missing data are errors. Grey stays grey and 16 bit stay 16 bit; palettes become Rgb, fewer than
/// 8 bit become 8, and alpha is dropped. Gamma and colour profiles are ignored. Decodes one
/// picture. Thread-bound.
class PngDecoder {
 public:
  PngDecoder();
  ~PngDecoder();

  /// Reads the header; `png` must live until the picture is decoded. Errors: not a PNG picture,
  /// header damaged, out of memory.
  Result<PngHeader> open(std::span<const std::byte> png);

  /// Decodes the opened picture up to its end into `target`, of its header's format and size;
  /// target's pixels are undefined after an error. Error: damaged.
  Result<> decode(const MutablePicture& target);

  /// EXIF data of the decoded picture, a TIFF header and what follows it; empty: it has none. Valid
  /// as long as the decoder.
  std::span<const std::byte> exif() const;

 private:
  std::unique_ptr<PngReader> reader_;
};

}  // namespace orbwatch::hal
