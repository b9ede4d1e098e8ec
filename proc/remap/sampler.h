#pragma once

#include <algorithm>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/remap/colour_conversion.h"
#include "proc/remap/coordinate_grid.h"

namespace orbwatch::remap {

/// Weighted mean of four samples: wu, wv in [0, 2^kFractionBits], rounded to nearest.
inline std::int64_t interpolate(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d,
                                std::int64_t wu, std::int64_t wv) {
  constexpr int kBits = 2 * kFractionBits;
  constexpr std::int64_t kUnit = std::int64_t{1} << kFractionBits;
  const std::int64_t top = a * (kUnit - wu) + b * wu;
  const std::int64_t bottom = c * (kUnit - wu) + d * wu;
  return (top * (kUnit - wv) + bottom * wv + (std::int64_t{1} << (kBits - 1))) >> kBits;
}

/// Where the four neighbours of a coordinate stand, and their weights.
struct Neighbours {
  int u0, u1, v0, v1;
  std::int32_t wu, wv;

  /// `c` lies so that all four are in the picture.
  static Neighbours interior(const Coordinate& c) {
    constexpr std::int32_t kMask = (1 << kFractionBits) - 1;
    const int u = c.u >> kFractionBits, v = c.v >> kFractionBits;
    return {u, u + 1, v, v + 1, c.u & kMask, c.v & kMask};
  }
  /// Beyond the border the outermost pixel goes on.
  static Neighbours clamped(const Coordinate& c, int width, int height) {
    Neighbours n = interior(c);
    n.u0 = std::clamp(n.u0, 0, width - 1);
    n.u1 = std::clamp(n.u1, 0, width - 1);
    n.v0 = std::clamp(n.v0, 0, height - 1);
    n.v1 = std::clamp(n.v1, 0, height - 1);
    return n;
  }
};

/// Reads interleaved samples: Grey, Y16, Rgb, Rgb16.
template <class T, int Channels>
struct InterleavedSampler {
  using Sample = T;
  static constexpr int kChannels = Channels;
  ImageView<const T> source;

  explicit InterleavedSampler(const Picture& picture) : source(picture.samples<T>()) {}

  void bilinear(const Neighbours& n, T* out) const {
    const T* a = source.at(n.u0, n.v0);
    const T* b = source.at(n.u1, n.v0);
    const T* c = source.at(n.u0, n.v1);
    const T* d = source.at(n.u1, n.v1);
    for (int k = 0; k < Channels; ++k) {
      out[k] = static_cast<T>(interpolate(a[k], b[k], c[k], d[k], n.wu, n.wv));
    }
  }
};

/// Reads Y0 U Y1 V. Chroma stands at the even luminance sample (the sited position that UVC and
/// MPEG-2 use) and is interpolated over its own half-width grid.
struct YuyvSampler {
  using Sample = std::uint8_t;
  static constexpr int kChannels = 3;
  ImageView<const std::uint8_t> source;
  YuvToRgb convert;

  explicit YuyvSampler(const Picture& picture)
      : source(picture.samples<std::uint8_t>()), convert(picture.colour_space) {}

  void bilinear(const Neighbours& n, std::uint8_t* out) const {
    const std::uint8_t* top = source.row(n.v0);
    const std::uint8_t* bottom = source.row(n.v1);
    const auto luminance =
        interpolate(top[2 * n.u0], top[2 * n.u1], bottom[2 * n.u0], bottom[2 * n.u1], n.wu, n.wv);
    const int left = n.u0 / 2, right = std::min(left + 1, source.width / 2 - 1);
    constexpr std::int32_t kUnit = 1 << kFractionBits;
    const std::int32_t weight = (n.u0 % 2 * kUnit + n.wu) / 2;
    const auto chroma = [&](int offset) {
      return interpolate(top[4 * left + offset], top[4 * right + offset], bottom[4 * left + offset],
                         bottom[4 * right + offset], weight, n.wv);
    };
    convert(static_cast<int>(luminance), static_cast<int>(chroma(1)), static_cast<int>(chroma(3)),
            out);
  }
};

}  // namespace orbwatch::remap
