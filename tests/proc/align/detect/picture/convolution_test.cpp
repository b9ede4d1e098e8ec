// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/convolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>
#include <vector>

namespace orbwatch::align {
namespace {

/// Layers of all kinds of reach and step, with numbers of outputs that no vector divides, and
/// numbers of columns from one to many vectors.
class Convolution : public testing::TestWithParam<std::tuple<Layer, int>> {
 private:
  std::mt19937 random_{3};  // before those that are drawn from it

 protected:
  const Layer layer = std::get<0>(GetParam());
  const Field in = random_field();
  const std::vector<float> weights = random_values(weight_count(layer));

  /// An output by the definition: the bias, then all inputs by channel, ray and column.
  float defined(int ray, int output, int column) const {
    std::size_t at = static_cast<std::size_t>(layer.outputs + output);
    float sum = weights[static_cast<std::size_t>(output)];
    for (int i = 0; i < layer.inputs; ++i) {
      for (int r = 0; r < layer.rays; ++r) {
        const float* const row = in.at(in.ring(layer.step * ray + r - layer.before), i);
        for (int t = 0; t < layer.columns; ++t, at += static_cast<std::size_t>(layer.outputs)) {
          const int from = column + t - layer.columns / 2;
          sum += weights[at] * (from < 0 || from >= in.columns() ? 0 : row[from]);
        }
      }
    }
    return sum;
  }

  void expect_definition(const Field& out) const {
    ASSERT_EQ(out.rays(), in.rays() / layer.step);
    ASSERT_EQ(out.channels(), layer.outputs);
    ASSERT_EQ(out.columns(), in.columns());
    for (int ray = 0; ray < out.rays(); ++ray) {
      for (int output = 0; output < out.channels(); ++output) {
        for (int k = 0; k < out.columns(); ++k) {
          ASSERT_FLOAT_EQ(out.at(ray, output)[k], defined(ray, output, k))
              << "ray " << ray << ", output " << output << ", column " << k;
        }
      }
    }
  }

 private:
  std::vector<float> random_values(std::size_t count) {
    // Small whole numbers, whose sums are exact in every order.
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(static_cast<int>(random_() % 17) - 8);
    return values;
  }
  Field random_field() {
    constexpr int kRays = 16;
    const int columns = std::get<1>(GetParam());
    Field field(kRays, layer.inputs, columns);
    for (int ray = 0; ray < kRays; ++ray) {
      for (int channel = 0; channel < layer.inputs; ++channel) {
        const std::vector<float> values = random_values(static_cast<std::size_t>(columns));
        std::copy(values.begin(), values.end(), field.at(ray, channel));
      }
    }
    return field;
  }
};

TEST_P(Convolution, IsTheSumOfTheDefinitionByVectorsOfFour) {
  expect_definition(convolution(in, layer, weights, false));
}

TEST_P(Convolution, IsTheSameByVectorsOfEight) {
  if (!has_vectors_of_eight()) GTEST_SKIP() << "this processor has no vectors of eight";
  expect_definition(convolution(in, layer, weights, true));
}

TEST_P(Convolution, LeavesZerosBesideTheColumns) {
  const Field out = convolution(in, layer, weights);
  for (const int beside : {-3, -1, out.columns(), out.columns() + 2}) {
    EXPECT_EQ(out.at(out.rays() - 1, layer.outputs - 1)[beside], 0) << beside;
  }
}

INSTANTIATE_TEST_SUITE_P(Layers, Convolution,
                         testing::Combine(testing::Values(Layer{4, 8, 8, 7, 4, 2},
                                                          Layer{3, 7, 4, 7, 2, 1},
                                                          Layer{5, 1, 3, 5, 1, 1}),
                                          testing::Values(1, 8, 13, 33, 68)));

}  // namespace
}  // namespace orbwatch::align
