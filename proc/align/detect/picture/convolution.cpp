// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/convolution.h"

#include <algorithm>
#include <cstring>

namespace orbwatch::align {
namespace {

/// Columns are summed by vectors of this many floats; wider ones need a processor's extension.
template <int lanes>
struct Vector {
  using Type [[gnu::vector_size(lanes * sizeof(float))]] = float;
};
constexpr int kFour = 4, kEight = 8;
constexpr int kBeside = 3;  // columns that a layer reaches to a side, at most

/// Computes the sums of one layer, each in the same order whatever the width of the vectors.
/// `together` outputs and up to `most` vectors of columns are summed at a time, in registers.
template <int lanes, int together, int most>
struct Sums {
  const Field& in;
  const Layer& layer;
  const float *biases, *taps;
  Field& out;

  using Lanes = typename Vector<lanes>::Type;

  /// Fills the columns of some vectors, of `outputs` channels.
  template <int outputs, int vectors>
  [[gnu::always_inline]] void fill(int ray, int output, int first) const {
    Lanes sums[outputs][vectors];
    for (int o = 0; o < outputs; ++o) {
      for (Lanes& sum : sums[o]) sum = biases[output + o] - Lanes{};
    }
    const float* weights = taps + output;
    for (int i = 0; i < layer.inputs; ++i) {
      int from = in.ring(layer.step * ray - layer.before);
      for (int r = 0; r < layer.rays; ++r, from = from + 1 == in.rays() ? 0 : from + 1) {
        const float* column = in.at(from, i) + first - layer.columns / 2;
        for (int t = 0; t < layer.columns; ++t, ++column, weights += layer.outputs) {
          for (int v = 0; v < vectors; ++v) {
            Lanes values;
            std::memcpy(&values, column + v * lanes, sizeof values);
            for (int o = 0; o < outputs; ++o) sums[o][v] += weights[o] * values;
          }
        }
      }
    }
    for (int o = 0; o < outputs; ++o) {
      const int count = std::min(vectors * lanes, in.columns() - first);
      std::memcpy(out.at(ray, output + o) + first, sums[o],
                  static_cast<std::size_t>(count) * sizeof(float));
    }
  }

  /// Fills as many columns from `first` on as `vectors` hold, in fewer vectors where that is all.
  template <int outputs, int vectors>
  [[gnu::always_inline]] void fill_up_to(int ray, int output, int first) const {
    if constexpr (vectors > 1) {
      if (in.columns() - first <= (vectors - 1) * lanes) {
        fill_up_to<outputs, vectors - 1>(ray, output, first);
        return;
      }
    }
    fill<outputs, vectors>(ray, output, first);
  }

  [[gnu::always_inline]] void fill_all() const {
    for (int ray = 0; ray < out.rays(); ++ray) {
      for (int first = 0; first < in.columns(); first += most * lanes) {
        int output = 0;
        for (; output + together <= layer.outputs; output += together) {
          fill_up_to<together, most>(ray, output, first);
        }
        for (; output < layer.outputs; ++output) fill_up_to<1, most>(ray, output, first);
      }
    }
  }
};

using SumsOfFour = Sums<kFour, 2, 3>;
#ifdef __x86_64__
using SumsOfEight = Sums<kEight, 4, 2>;

[[gnu::target("avx2")]] void fill_all(const SumsOfEight& sums) { sums.fill_all(); }
#endif

}  // namespace

Field::Field(int rays, int channels, int columns)
    : rays_(rays),
      channels_(channels),
      columns_(columns),
      stride_((columns + kEight - 1) / kEight * kEight + 2 * kBeside),
      values_(static_cast<std::size_t>(rays * channels * stride_)) {}

std::size_t Field::first(int ray, int channel) const {
  return static_cast<std::size_t>((ray * channels_ + channel) * stride_ + kBeside);
}

bool has_vectors_of_eight() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

Field convolution(const Field& in, const Layer& layer, std::span<const float> weights,
                  [[maybe_unused]] bool by_eight) {
  Field out(in.rays() / layer.step, layer.outputs, in.columns());
  const float* const taps = weights.data() + layer.outputs;
#ifdef __x86_64__
  if (by_eight) {
    fill_all(SumsOfEight{in, layer, weights.data(), taps, out});
    return out;
  }
#endif
  SumsOfFour{in, layer, weights.data(), taps, out}.fill_all();
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
