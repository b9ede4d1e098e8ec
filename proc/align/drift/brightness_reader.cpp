// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/brightness_reader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace orbwatch::align {
namespace {

/// Brightness as a weighted sum of a pixel's samples from `first` on; OpenCV's weights.
struct BrightnessWeights {
  std::size_t first = 0;
  std::array<float, 3> of{1, 0, 0};
};

constexpr float kRedWeight = 0.299F, kGreenWeight = 0.587F, kBlueWeight = 0.114F;

BrightnessWeights weights_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::Uyvy:
      return {1, {1, 0, 0}};
    case PixelFormat::Rgb:
    case PixelFormat::Rgb16:
      return {0, {kRedWeight, kGreenWeight, kBlueWeight}};
    case PixelFormat::Bgr:
    case PixelFormat::Bgra:
      return {0, {kBlueWeight, kGreenWeight, kRedWeight}};
    case PixelFormat::Yuyv:
    case PixelFormat::Grey:
    case PixelFormat::Y10:
    case PixelFormat::Y12:
    case PixelFormat::Y16:
    case PixelFormat::Nv12:
    case PixelFormat::Nv21:
    case PixelFormat::I420:
      break;
  }
  return {};
}

/// Rows of samples of a picture's first plane.
struct SampleRows {
  const std::byte* data;
  std::ptrdiff_t stride;  ///< bytes between two rows that are read
  std::ptrdiff_t step;    ///< pixels between two that are read
};

/// A square whose values are means of `dense` x `dense` samples, each of `channels` of which `used`
/// count.
template <class Sample, int channels, int used, int dense>
void read_square(const SampleRows& rows, const BrightnessWeights& weights,
                 BrightnessReader::Square& square) {
  constexpr int kPixels = BrightnessReader::kSide * dense;
  // Two samples of 8 bit fit 16 bit, which is faster.
  using Sum = std::conditional_t<sizeof(Sample) == 1, std::uint16_t, std::uint32_t>;
  const std::byte* data = rows.data;
  for (int v = 0; v < BrightnessReader::kSide; ++v) {
    std::array<Sum, kPixels * channels> sums{};
    for (int row = 0; row < dense; ++row, data += rows.stride) {
      const auto* const samples = reinterpret_cast<const Sample*>(data);
      if (rows.step == 1) {
        for (std::size_t n = 0; n < sums.size(); ++n) sums[n] += samples[n];
        continue;
      }
      for (int u = 0; u < kPixels; ++u) {
        for (int c = 0; c < channels; ++c) {
          sums[static_cast<std::size_t>(u * channels + c)] += samples[u * rows.step * channels + c];
        }
      }
    }
    float* const out = square.data() + v * BrightnessReader::kSide;
    for (std::size_t u = 0; u < BrightnessReader::kSide; ++u) {
      const Sum* const sum = sums.data() + u * dense * channels + weights.first;
      float value = 0;
      for (int c = 0; c < used; ++c) {
        const auto all = static_cast<float>(dense == 1 ? sum[c] : sum[c] + sum[c + channels]);
        value += used == 1 ? all : weights.of[static_cast<std::size_t>(c)] * all;
      }
      out[u] = value * (1.0F / (dense * dense));
    }
  }
}

template <class Sample, int channels, int used = channels>
void read_samples(int dense, const SampleRows& rows, const BrightnessWeights& weights,
                  BrightnessReader::Square& square) {
  if (dense == 1) return read_square<Sample, channels, used, 1>(rows, weights, square);
  read_square<Sample, channels, used, BrightnessReader::kDense>(rows, weights, square);
}

}  // namespace

bool BrightnessReader::read(const Picture& picture, cv::Point first, Square& square) const {
  const int side = scale_ * kSide;
  if (first.x < 0 || first.y < 0 || first.x + side > picture.width ||
      first.y + side > picture.height) {
    return false;
  }
  const PixelFormatInfo& facts = info(picture.format);
  const int dense = scale_ == 1 ? 1 : kDense, step = std::max(1, scale_ / kDense);
  const std::ptrdiff_t stride = picture.planes[0].stride;
  const std::ptrdiff_t pixel = facts.channels() * facts.bytes_per_sample();
  const SampleRows rows{picture.planes[0].data + first.y * stride + first.x * pixel, step * stride,
                        step};
  const BrightnessWeights weights = weights_of(picture.format);
  const bool is_wide = facts.bytes_per_sample() == 2;
  switch (facts.channels()) {
    case 1:
      is_wide ? read_samples<std::uint16_t, 1>(dense, rows, weights, square)
              : read_samples<std::uint8_t, 1>(dense, rows, weights, square);
      return true;
    case 2:
      read_samples<std::uint8_t, 2, 1>(dense, rows, weights, square);
      return true;
    case 3:
      is_wide ? read_samples<std::uint16_t, 3>(dense, rows, weights, square)
              : read_samples<std::uint8_t, 3>(dense, rows, weights, square);
      return true;
    default:
      read_samples<std::uint8_t, 4, 3>(dense, rows, weights, square);
      return true;
  }
}

}  // namespace orbwatch::align
