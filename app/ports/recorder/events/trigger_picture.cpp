// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/trigger_picture.h"

#include <algorithm>
#include <limits>

#include "proc/image/pixel_format.h"

namespace orbwatch::app::recorder {
namespace {

bool is_grey16(PixelFormat format) {
  return info(format).colour == ColourModel::Luminance && info(format).bytes_per_sample() > 1;
}

/// The samples as 8 bit, from 0 for the darkest to 255 for the brightest.
std::vector<std::uint8_t> stretched(const ImageView<const std::uint16_t>& samples) {
  std::uint16_t low = std::numeric_limits<std::uint16_t>::max(), high = 0;
  for (int y = 0; y < samples.height; ++y) {
    const auto [least, most] = std::minmax_element(samples.row(y), samples.row(y) + samples.width);
    low = std::min(low, *least);
    high = std::max(high, *most);
  }
  const unsigned range = std::max(1, high - low);
  std::vector<std::uint8_t> grey;
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      grey.push_back(static_cast<std::uint8_t>((samples.row(y)[x] - low) * 255U / range));
    }
  }
  return grey;
}

}  // namespace

Result<std::span<std::uint8_t>> jpeg_for_people(JpegEncoder& encoder, const Picture& picture,
                                                int quality) {
  if (!is_grey16(picture.format)) return encoder.encode(picture, quality);
  std::vector<std::uint8_t> grey = stretched(picture.samples<std::uint16_t>());
  const ImageView<std::uint8_t> view{grey.data(), picture.width, picture.height, 1, picture.width};
  return encoder.encode(picture_of(PixelFormat::Grey, view), quality);
}

}  // namespace orbwatch::app::recorder
