// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <turbojpeg.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace orbwatch::hal {

inline constexpr int kBallWidth = 320;
inline constexpr int kBallHeight = 240;

/// Luminance, 0..1, that a mirror ball in a striped room shows at a pixel, when the room is turned
/// by `turn`: normals of a unit sphere reflect rays along -z.
inline double ball_luminance(int x, int y, double turn) {
  const double u = (x - kBallWidth / 2.0) / 110.0;
  const double v = (y - kBallHeight / 2.0) / 110.0;
  const double rr = u * u + v * v;
  if (rr >= 1) return 0.1;
  const double nz = std::sqrt(1 - rr);
  const double azimuth = std::atan2(2 * nz * u, 2 * nz * nz - 1);
  return 0.5 + 0.4 * std::sin(3 * azimuth + turn) * std::cos(2 * nz * v);
}

/// Samples of `bytes` bytes, low byte first, of a picture of the ball, turned for picture n.
inline std::vector<std::byte> ball_samples(int n, int bytes, int columns, int rows) {
  std::vector<std::byte> samples;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const double value = ball_luminance(x * kBallWidth / columns, y, 0.7 * n);
      const auto count = static_cast<unsigned>(value * (bytes == 2 ? 65535 : 255));
      samples.push_back(static_cast<std::byte>(count & 255U));
      if (bytes == 2) samples.push_back(static_cast<std::byte>(count >> 8));
    }
  }
  return samples;
}

/// JPEG picture of the ball in 8 bit, with chroma that falls from left to right (4:2:0).
inline std::vector<std::byte> ball_jpeg(int n) {
  const auto luma = ball_samples(n, 1, kBallWidth, kBallHeight);
  std::vector<unsigned char> u;
  std::vector<unsigned char> v;
  for (int y = 0; y < kBallHeight / 2; ++y) {
    for (int x = 0; x < kBallWidth / 2; ++x) {
      u.push_back(static_cast<unsigned char>(200 - x));
      v.push_back(static_cast<unsigned char>(60 + y));
    }
  }
  const unsigned char* planes[3] = {reinterpret_cast<const unsigned char*>(luma.data()), u.data(),
                                    v.data()};
  const int strides[3] = {kBallWidth, kBallWidth / 2, kBallWidth / 2};
  tjhandle encoder = tjInitCompress();
  unsigned char* file = nullptr;
  unsigned long size = 0;
  tjCompressFromYUVPlanes(encoder, planes, kBallWidth, strides, kBallHeight, TJSAMP_420, &file,
                          &size, 95, 0);
  const auto* first = reinterpret_cast<const std::byte*>(file);
  std::vector<std::byte> jpeg(first, first + size);
  tjFree(file);
  tjDestroy(encoder);
  return jpeg;
}

}  // namespace orbwatch::hal
