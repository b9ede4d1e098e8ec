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

/// What the header of a JPEG picture states, before its EXIF orientation is applied.
struct JpegSize {
  int width = 0;
  int height = 0;
};

/// libjpeg-turbo without its forgiveness: whatever it would patch over (a file that ends early, a
/// broken code, bytes lost on the USB) is an error here, because a patched picture must not be
/// measured. Reads grey and YCbCr pictures, baseline and progressive, also those that leave out the
/// standard Huffman tables as USB cameras do. Thread-bound; keep one per thread, it is reused.
class JpegDecoder {
 public:
  JpegDecoder();

  /// Errors: not a JPEG picture, header damaged, CMYK.
  Result<JpegSize> read_size(std::span<const std::byte> jpeg);

  /// Reads all of the compressed data without making a picture of full size. Errors as read_size,
  /// and damaged data.
  Result<> check(std::span<const std::byte> jpeg);

  /// The luminance alone into `target`, 1 channel of 8 bit; a colour picture's colours are not
  /// even computed. Errors as check, and another size than target's; target's pixels are then
  /// undefined.
  Result<> decode_grey(std::span<const std::byte> jpeg, const ImageView<std::uint8_t>& target);

  /// Into `target`, Nv12, without a detour through R G B: BT.601, full range. Chroma with more
  /// detail than Nv12 has is averaged; grey pictures get none. Errors as decode_grey, an RGB
  /// picture, and widths that are no multiple of 4 with chroma shared by 4 pixels.
  Result<> decode_nv12(std::span<const std::byte> jpeg, const MutablePicture& target);

 private:
  struct Close {
    void operator()(void* decoder) const;
  };

  /// What the header says in turbojpeg's words.
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
  std::vector<std::uint8_t> thumbnail_;              ///< what check() decodes into
  std::array<std::vector<std::uint8_t>, 2> chroma_;  ///< U and V with the detail of the file
};

}  // namespace orbwatch::hal
