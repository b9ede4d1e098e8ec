// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/trigger_picture.h"

#include <algorithm>

#include "proc/image/pixel_format.h"

namespace orbwatch::app::recorder {

bool is_stretched(PixelFormat format) {
  return info(format).colour == ColourModel::Luminance && info(format).bytes_per_sample() > 1;
}

void extend(GreyRange& range, const ImageView<const std::uint16_t>& samples) {
  for (int y = 0; y < samples.height; ++y) {
    const auto [least, most] = std::minmax_element(samples.row(y), samples.row(y) + samples.width);
    range.low = std::min(range.low, *least);
    range.high = std::max(range.high, *most);
  }
}

std::vector<std::uint8_t> stretched(const ImageView<const std::uint16_t>& samples,
                                    const GreyRange& range) {
  const unsigned width = std::max(1, range.high - range.low);
  std::vector<std::uint8_t> grey;
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      grey.push_back(static_cast<std::uint8_t>((samples.row(y)[x] - range.low) * 255U / width));
    }
  }
  return grey;
}

Result<std::span<std::uint8_t>> jpeg_for_people(JpegEncoder& encoder, const Picture& picture,
                                                int quality) {
  if (!is_stretched(picture.format)) return encoder.encode(picture, quality);
  GreyRange range;
  extend(range, picture.samples<std::uint16_t>());
  std::vector<std::uint8_t> grey = stretched(picture.samples<std::uint16_t>(), range);
  const ImageView<std::uint8_t> view{grey.data(), picture.width, picture.height, 1, picture.width};
  return encoder.encode(picture_of(PixelFormat::Grey, view), quality);
}

}  // namespace orbwatch::app::recorder
