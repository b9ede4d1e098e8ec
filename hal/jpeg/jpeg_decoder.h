#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "proc/image/image_view.h"
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

  /// Decodes into `target`, 3 channels R G B of 8 bit. Errors as check, and another size than
  /// target's; target's pixels are then undefined.
  Result<> decode_rgb(std::span<const std::byte> jpeg, ImageView<std::uint8_t> target);

 private:
  struct Close {
    void operator()(void* decoder) const;
  };

  tl::unexpected<Error> failed(const char* what);
  Result<> decompress(std::span<const std::byte> jpeg, ImageView<std::uint8_t> target);

  std::unique_ptr<void, Close> decoder_;
  std::vector<std::uint8_t> thumbnail_;  ///< what check() decodes into
};

}  // namespace orbwatch::hal
