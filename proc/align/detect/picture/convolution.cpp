// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/convolution.h"

#include <algorithm>
#include <cstring>

namespace orbwatch::align {
namespace {

/// Columns are summed in blocks of this size, in registers.
using Lanes [[gnu::vector_size(16)]] = float;
constexpr int kLanes = 4, kVectors = 3, kBlock = kLanes * kVectors;
constexpr int kBeside = 3;  // columns that a layer reaches to a side, at most

/// Computes the sums of one layer.
struct Sums {
  const Field& in;
  const Layer& layer;
  const float *biases, *taps;
  Field& out;

  /// Fills a block of columns of `outputs` channels.
  template <int outputs>
  void fill(int ray, int output, int first) const {
    Lanes sums[outputs][kVectors];
    for (int o = 0; o < outputs; ++o) {
      for (Lanes& sum : sums[o]) sum = biases[output + o] - Lanes{};
    }
    const float* weights = taps + output;
    for (int i = 0; i < layer.inputs; ++i) {
      for (int r = 0; r < layer.rays; ++r) {
        const int from = in.ring(layer.step * ray + r - layer.before);
        const float* column = in.at(from, i) + first - layer.columns / 2;
        for (int t = 0; t < layer.columns; ++t, ++column, weights += layer.outputs) {
          for (int v = 0; v < kVectors; ++v) {
            Lanes values;
            std::memcpy(&values, column + v * kLanes, sizeof values);
            for (int o = 0; o < outputs; ++o) sums[o][v] += weights[o] * values;
          }
        }
      }
    }
    for (int o = 0; o < outputs; ++o) {
      const int count = std::min(kBlock, in.columns() - first);
      std::memcpy(out.at(ray, output + o) + first, sums[o],
                  static_cast<std::size_t>(count) * sizeof(float));
    }
  }
};

}  // namespace

Field::Field(int rays, int channels, int columns)
    : rays_(rays),
      channels_(channels),
      columns_(columns),
      stride_((columns + kBlock - 1) / kBlock * kBlock + 2 * kBeside),
      values_(static_cast<std::size_t>(rays * channels * stride_)) {}

std::size_t Field::first(int ray, int channel) const {
  return static_cast<std::size_t>((ray * channels_ + channel) * stride_ + kBeside);
}

Field convolution(const Field& in, const Layer& layer, std::span<const float> weights) {
  Field out(in.rays() / layer.step, layer.outputs, in.columns());
  const Sums sums{in, layer, weights.data(), weights.data() + layer.outputs, out};
  for (int ray = 0; ray < out.rays(); ++ray) {
    for (int first = 0; first < in.columns(); first += kBlock) {
      int output = 0;
      for (; output + 1 < layer.outputs; output += 2) sums.fill<2>(ray, output, first);
      for (; output < layer.outputs; ++output) sums.fill<1>(ray, output, first);
    }
  }
  return out;
}

void rectify(Field& field) {
  for (int ray = 0; ray < field.rays(); ++ray) {
    for (int c = 0; c < field.channels(); ++c) {
      float* const values = field.at(ray, c);
      for (int k = 0; k < field.columns(); ++k) values[k] = std::max(values[k], 0.F);
    }
  }
}

}  // namespace orbwatch::align
