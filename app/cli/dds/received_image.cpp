#include "app/cli/dds/received_image.h"

#include <algorithm>
#include <string>

namespace orbwatch::app {

Result<ReceivedImage> check_image(const ImageMessage& message) {
  const auto encoding =
      std::ranges::find(kImageEncodings, std::string_view(message.encoding), &ImageEncoding::name);
  // The message does not quote the sender, whose text may hold control characters.
  if (encoding == kImageEncodings.end()) {
    return fail("image: encoding is none of rgb8, bgr8, mono8, mono16");
  }
  const std::uint32_t width = message.width;
  const std::uint32_t height = message.height;
  if (width == 0 || height == 0 || width > kMaxImageSide || height > kMaxImageSide) {
    return fail("image: " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels, each side must be 1 to " + std::to_string(kMaxImageSide));
  }
  if (message.step < width * encoding->bytes_per_pixel()) {
    return fail("image: step of " + std::to_string(message.step) + " bytes, a row needs " +
                std::to_string(width * encoding->bytes_per_pixel()));
  }
  if (message.step % encoding->bytes_per_sample != 0) {
    return fail("image: step of " + std::to_string(message.step) + " bytes, samples have " +
                std::to_string(encoding->bytes_per_sample));
  }
  const std::uint64_t size = std::uint64_t{message.step} * height;
  if (message.data._length != size) {
    return fail("image: " + std::to_string(message.data._length) +
                " bytes of data, step and height say " + std::to_string(size));
  }
  return ReceivedImage{
      *encoding,
      width,
      height,
      message.step,
      message.data._buffer,
      encoding->bytes_per_sample > 1 && (message.is_bigendian != 0) != kBigEndianHost};
}

}  // namespace orbwatch::app
