// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/pyramid.h"

#include <algorithm>
#include <cstdint>

#include "proc/remap/sampling/downsampling.h"
#include "proc/remap/sampling/plane_sampling.h"

namespace orbwatch::remap {
namespace {

/// Half a side; sides along which chroma is subsampled stay even.
int half(int side, bool shared) { return shared ? side / 4 * 2 : side / 2; }

}  // namespace

Pyramid::Pyramid(PixelFormat format, int width, int height, int levels) {
  bool shared_x = false, shared_y = false;
  for (const PlaneSampling& sampling : samplings(format)) {
    shared_x |= sampling.x != Siting::Full;
    shared_y |= sampling.y != Siting::Full;
  }
  pictures_[0] = {format, {}, width, height, {}};
  std::array<std::size_t, kMaxLevel + 1> start{};
  std::size_t bytes = 0;
  while (levels_ < std::min(levels, kMaxLevel)) {
    const Picture& below = pictures_[levels_];
    const int w = half(below.width, shared_x), h = half(below.height, shared_y);
    if (w < 2 || h < 2) break;
    ++levels_;
    start[levels_] = bytes;
    pictures_[levels_] = {format, {}, w, h, {}};
    bytes += picture_bytes(format, static_cast<std::size_t>(row_bytes(format, w)), h);
  }
  memory_.resize(bytes);
  for (int level = 1; level <= levels_; ++level) {
    const Picture& picture = pictures_[level];
    filled_[level] =
        MutablePicture::contiguous(format, picture.width, picture.height,
                                   memory_.data() + start[level], row_bytes(format, picture.width));
    pictures_[level] = filled_[level];
  }
}

void Pyramid::set_source(const Picture& source) { pictures_[0] = source; }

void Pyramid::fill(int level, int first, int last) {
  const Picture& below = pictures_[level - 1];
  const MutablePicture& out = filled_[level];
  for (const PlaneSampling& sampling : samplings(below.format)) {
    const auto& from = below.planes[sampling.plane];
    const auto& to = out.planes[sampling.plane];
    const auto* in = reinterpret_cast<const std::uint8_t*>(from.data) + sampling.offset;
    auto* const filled = reinterpret_cast<std::uint8_t*>(to.data) + sampling.offset;
    const int shift_y = shift(sampling.y);
    const int end = std::min(2 * last, out.height) >> shift_y;
    for (int y = 2 * first >> shift_y; y < end; ++y) {
      const std::uint8_t* upper = in + 2 * y * from.stride;
      box_filter(sampling.layout)(upper, upper + from.stride, filled + y * to.stride,
                                  out.width >> shift(sampling.x));
    }
  }
}

void Pyramid::fill() {
  for (int level = 1; level <= levels_; ++level) fill(level, 0, row_pairs(level));
}

}  // namespace orbwatch::remap
