// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/frame.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <random>

namespace orbwatch::bench {
namespace {

constexpr int kCacheLine = 64;

std::ptrdiff_t padded_stride(int row_bytes) {
  const int lines = (row_bytes + kCacheLine - 1) / kCacheLine;
  return std::ptrdiff_t{lines % 2 == 0 ? lines + 1 : lines} * kCacheLine;
}

}  // namespace

Plane Plane::blank(int width, int height, int samples, int sample_bytes) {
  Plane plane{width, height, samples, sample_bytes, padded_stride(width * samples * sample_bytes),
              {}};
  plane.bytes.resize(static_cast<std::size_t>(plane.stride) * static_cast<std::size_t>(height));
  return plane;
}

void Plane::fill_with_noise(unsigned seed) {
  std::mt19937 random(seed);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() & 0xff);
}

void Plane::fill_with_waves(unsigned seed) {
  const auto wave = [&](int length) {
    std::vector<double> values(static_cast<std::size_t>(length));
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::sin(static_cast<double>(i) * (2 * std::numbers::pi / 60) + seed);
    }
    return values;
  };
  const std::vector<double> across = wave(width), down = wave(height);
  const double middle = (std::exp2(8 * sample_bytes) - 1) / 2;
  for (int y = 0; y < height; ++y) {
    std::byte* to = bytes.data() + y * stride;
    for (int i = 0; i < width * samples; ++i, to += sample_bytes) {
      const auto value =
          static_cast<std::uint16_t>(middle * (1 + 0.9 * across[i / samples] * down[y]));
      std::memcpy(to, &value, static_cast<std::size_t>(sample_bytes));
    }
  }
}

int Plane::sample(int x, int y, int k) const {
  const std::byte* at =
      bytes.data() + y * stride + (std::ptrdiff_t{x} * samples + k) * sample_bytes;
  if (sample_bytes == 1) return std::to_integer<int>(*at);
  std::uint16_t value = 0;
  std::memcpy(&value, at, sizeof value);
  return value;
}

Frame Frame::blank(PixelFormat format, int width, int height) {
  Frame frame{format, width, height, {}};
  const PixelFormatInfo& facts = info(format);
  for (std::size_t n = 0; n < facts.plane_count(); ++n) {
    const PlaneInfo& plane = facts.planes[n];
    frame.planes.push_back(Plane::blank(width >> plane.shift_x, height >> plane.shift_y,
                                        plane.samples, facts.bytes_per_sample()));
  }
  return frame;
}

void Frame::fill_with_noise(unsigned seed) {
  for (Plane& plane : planes) plane.fill_with_noise(seed++);
}

void Frame::fill_with_waves(unsigned seed) {
  for (Plane& plane : planes) plane.fill_with_waves(seed++);
}

MutablePicture Frame::picture() {
  MutablePicture picture{format, {}, width, height, {}};
  for (std::size_t n = 0; n < planes.size(); ++n) {
    picture.planes[n] = {planes[n].bytes.data(), planes[n].stride};
  }
  return picture;
}

Picture Frame::picture() const {
  Picture picture{format, {}, width, height, {}};
  for (std::size_t n = 0; n < planes.size(); ++n) {
    picture.planes[n] = {planes[n].bytes.data(), planes[n].stride};
  }
  return picture;
}

}  // namespace orbwatch::bench
