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

/// From the header of a JPEG picture, before its EXIF orientation is applied.
struct JpegSize {
  int width = 0;
  int height = 0;
};

/// libjpeg-turbo in strict mode: data that it would repair (a truncated file, a broken code, bytes
/// lost on USB) is an error here, because a repaired picture must not be measured. Reads grey and
/// YCbCr pictures, baseline and progressive, also without the standard Huffman tables, which USB
/// cameras omit. Thread-bound and reusable.
class JpegDecoder {
 public:
  JpegDecoder();

  /// Errors: not a JPEG picture, header damaged, CMYK.
  Result<JpegSize> read_size(std::span<const std::byte> jpeg);

  /// Reads all compressed data without decoding at full size. Errors as read_size, and damaged
  /// data.
  Result<> check(std::span<const std::byte> jpeg);

  /// Decodes the luminance only, into `target`, 1 channel of 8 bit. Errors as check, and another
  /// size than target's; target's pixels are then undefined.
  Result<> decode_grey(std::span<const std::byte> jpeg, const ImageView<std::uint8_t>& target);

  /// Decodes into `target`, Nv12, BT.601 of full range, without conversion to RGB. Finer chroma is
  /// averaged; grey pictures get neutral chroma. Errors as decode_grey, an RGB picture, and widths
  /// that are no multiple of 4 with chroma shared by 4 pixels.
  Result<> decode_nv12(std::span<const std::byte> jpeg, const MutablePicture& target);

 private:
  struct Close {
    void operator()(void* decoder) const;
  };

  /// turbojpeg's header fields.
  struct Header {
    JpegSize size;
    int subsampling = 0;
    int colours = 0;
  };

  tl::unexpected<Error> failed(const char* what);
  Result<Header> read_header(std::span<const std::byte> jpeg);
  Result<Header> read_header_of(int width, int height, std::span<const std::byte> jpeg);
  Result<> decompress_grey(std::span<const std::byte> jpeg, const ImageView<std::uint8_t>& target);

  std::unique_ptr<void, Close> decoder_;
  std::vector<std::uint8_t> thumbnail_;              ///< target of check()
  std::array<std::vector<std::uint8_t>, 2> chroma_;  ///< U and V in the file's resolution
};

}  // namespace orbwatch::hal
