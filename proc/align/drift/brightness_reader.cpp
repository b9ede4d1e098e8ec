// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/brightness_reader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "proc/align/brightness_samples.h"

namespace orbwatch::align {
namespace {

/// Brightness as a weighted sum of a pixel's samples from `first` on; OpenCV's weights.
struct BrightnessWeights {
  std::size_t first = 0;
  std::array<float, 3> of{1, 0, 0};
};

constexpr float kRedWeight = 0.299F, kGreenWeight = 0.587F, kBlueWeight = 0.114F;

BrightnessWeights weights_of(PixelFormat format) {
  switch (brightness_samples(format)) {
    case BrightnessSamples::First:
      break;
    case BrightnessSamples::Second:
      return {1, {1, 0, 0}};
    case BrightnessSamples::RedGreenBlue:
      return {0, {kRedWeight, kGreenWeight, kBlueWeight}};
    case BrightnessSamples::BlueGreenRed:
      return {0, {kBlueWeight, kGreenWeight, kRedWeight}};
  }
  return {};
}

/// Rows of samples of a picture's first plane.
struct SampleRows {
  const std::byte* data;
  std::ptrdiff_t stride;  ///< bytes between two rows that are read
  std::ptrdiff_t step;    ///< pixels between two that are read
};

/// Samples of a row of a square, summed over `dense` rows of the picture.
template <class Sample, int channels, int dense>
struct SummedRow {
  static constexpr std::size_t kPixels = BrightnessReader::kSide * dense;
  /// Sums of 8 bit samples fit 16 bit, which is faster.
  using Sum = std::conditional_t<sizeof(Sample) == 1, std::uint16_t, std::uint32_t>;

  std::array<Sum, kPixels * channels> sums;

  /// `data`: the first of the rows.
  void read(const std::byte* data, const SampleRows& rows) {
    const auto* const above = reinterpret_cast<const Sample*>(data);
    const auto* const below = reinterpret_cast<const Sample*>(data + (dense - 1) * rows.stride);
    const auto sum_at = [&](std::ptrdiff_t n) {
      return static_cast<Sum>(dense == 1 ? above[n] : above[n] + below[n]);
    };
    if (rows.step == 1) {
      for (std::size_t n = 0; n < sums.size(); ++n)
        sums[n] = sum_at(static_cast<std::ptrdiff_t>(n));
      return;
    }
    for (std::size_t u = 0; u < kPixels; ++u) {
      const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(u) * rows.step * channels;
      for (std::size_t c = 0; c < channels; ++c) {
        sums[u * channels + c] = sum_at(pixel + static_cast<std::ptrdiff_t>(c));
      }
    }
  }

  /// The sum over `dense` x `dense` samples; `n` of the first one.
  Sum square(std::size_t n) const {
    return static_cast<Sum>(dense == 1 ? sums[n] : sums[n] + sums[n + channels]);
  }
};

/// Brightness of a row from its samples with their weights.
template <class Sample, int channels, int used, int dense>
class WeightedRow {
 public:
  explicit WeightedRow(const BrightnessWeights& weights) : weights_(weights) {
    if constexpr (used == 1) return;
    std::array<std::uint16_t, channels> fixed{};
    for (std::size_t c = 0; c < used; ++c) {
      fixed[c] = static_cast<std::uint16_t>(std::lround(65536 * weights.of[c]));
    }
    for (std::size_t n = 0; n < kSums; n += channels) {
      std::copy(fixed.begin(), fixed.end(), repeated_.begin() + static_cast<std::ptrdiff_t>(n));
    }
  }

  void write(const SummedRow<Sample, channels, dense>& row, float* out) const {
    constexpr float kMean = 1.0F / (dense * dense);
    if constexpr (used == 1) {
      for (std::size_t u = 0; u < BrightnessReader::kSide; ++u) {
        out[u] = kMean * static_cast<float>(row.square(u * kStep + weights_.first));
      }
    } else if constexpr (sizeof(Sample) == 1) {
      // All of them are multiplied in one sweep, which the compiler makes of vectors. Sums of four
      // have 10 bits: 6 bits are left for fractions.
      std::array<std::uint16_t, kSums> products;
      for (std::size_t n = 0; n < kSums; ++n) {
        const auto scaled = static_cast<std::uint16_t>(row.square(n) << 6);
        products[n] = static_cast<std::uint16_t>((std::uint32_t{scaled} * repeated_[n]) >> 16);
      }
      for (std::size_t u = 0; u < BrightnessReader::kSide; ++u) {
        const std::uint16_t* const product = products.data() + u * kStep;
        out[u] = kMean / 64 * static_cast<float>(product[0] + product[1] + product[2]);
      }
    } else {
      for (std::size_t u = 0; u < BrightnessReader::kSide; ++u) {
        float value = 0;
        for (std::size_t c = 0; c < used; ++c) {
          value += weights_.of[c] * static_cast<float>(row.square(u * kStep + c));
        }
        out[u] = kMean * value;
      }
    }
  }

 private:
  static constexpr std::size_t kStep = dense * channels;
  static constexpr std::size_t kSums = (BrightnessReader::kSide - 1) * kStep + channels;

  BrightnessWeights weights_;
  std::array<std::uint16_t, kSums> repeated_{};
};

/// A square whose values are means of `dense` x `dense` samples, each of `channels` of which `used`
/// count.
template <class Sample, int channels, int used, int dense>
void read_square(const SampleRows& rows, const BrightnessWeights& weights,
                 BrightnessReader::Square& square) {
  const WeightedRow<Sample, channels, used, dense> weighted(weights);
  SummedRow<Sample, channels, dense> row;
  for (int v = 0; v < BrightnessReader::kSide; ++v) {
    row.read(rows.data + v * dense * rows.stride, rows);
    weighted.write(row, square.data() + v * BrightnessReader::kSide);
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
