// SPDX-License-Identifier: Apache-2.0
#include "hal/test_pattern/painted_number.h"

#include <cstddef>

namespace orbwatch::hal {
namespace {

template <class Sample>
void paint(const BasicPicture<std::byte>::Plane& plane, const Picture& picture, int samples,
           std::uint32_t bits) {
  constexpr int kSquares = 2 * kNumberBits;
  const int side = number_square(picture.width, picture.height);
  const int left = std::max(0, (picture.width - kSquares * side) / 2);
  const int top = picture.height / 2 + picture.height / 20;
  const int right = std::min(picture.width, left + kSquares * side);
  const double full = (1 << info(picture.format).bits) - 1;
  const auto dark = static_cast<Sample>(full * kDarkLevel);
  const auto bright = static_cast<Sample>(full * kBrightLevel);
  for (int y = top; y < std::min(picture.height, top + side); ++y) {
    auto* const row = reinterpret_cast<Sample*>(plane.data + y * plane.stride);
    for (int x = left; x < right; ++x) {
      const int bit = kSquares - 1 - (x - left) / side;
      const bool is_one = (bits >> bit & 1U) != 0;
      std::fill_n(row + x * samples, samples, is_one ? bright : dark);
    }
  }
}

}  // namespace

void paint_number(FrameBuffer& buffer, std::uint64_t number) {
  const Picture& picture = buffer.picture;
  const auto out = MutablePicture::contiguous(picture.format, picture.width, picture.height,
                                              buffer.memory, picture.planes[0].stride);
  const auto low = static_cast<std::uint16_t>(number);
  const std::uint32_t bits = std::uint32_t{low} << kNumberBits | static_cast<std::uint16_t>(~low);
  const PixelFormatInfo& format = info(picture.format);
  const int samples = format.planes[0].samples;
  if (format.bytes_per_sample() == 2) {
    paint<std::uint16_t>(out.planes[0], picture, samples, bits);
  } else {
    paint<std::uint8_t>(out.planes[0], picture, samples, bits);
  }
}

}  // namespace orbwatch::hal
