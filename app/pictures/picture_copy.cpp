// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/picture_copy.h"

#include <cstring>

namespace orbwatch::app {

RecordedPicture copied(const Picture& picture, std::chrono::nanoseconds time) {
  const int stride = row_bytes(picture.format, picture.width);
  RecordedPicture copy;
  copy.time = time;
  copy.storage = std::make_unique<std::byte[]>(
      picture_bytes(picture.format, static_cast<std::size_t>(stride), picture.height));
  auto target = MutablePicture::contiguous(picture.format, picture.width, picture.height,
                                           copy.storage.get(), stride);
  target.colour_space = picture.colour_space;
  const PixelFormatInfo& facts = info(picture.format);
  for (std::size_t n = 0; n < facts.plane_count(); ++n) {
    const auto [data, to] = target.planes[n];
    for (int y = 0; y < picture.height >> facts.planes[n].shift_y; ++y) {
      std::memcpy(data + y * to, picture.planes[n].data + y * picture.planes[n].stride,
                  static_cast<std::size_t>(to));
    }
  }
  copy.picture = target;
  return copy;
}

}  // namespace orbwatch::app
