// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/normal_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace orbwatch::align {
namespace {

constexpr double kOutermostNode = 6.5;  // beyond it both differ from 0 or 1 by less than 1e-9
constexpr int kNodesPerUnit = 32;
constexpr int kNodes = static_cast<int>(2 * kOutermostNode * kNodesPerUnit) + 1;

using NormalNodes = std::array<NormalStep, kNodes>;

double place_of_node(int node) {
  return static_cast<double>(node) / kNodesPerUnit - kOutermostNode;
}

NormalNodes computed_nodes() {
  NormalNodes nodes;
  for (int n = 0; n < kNodes; ++n) {
    const double x = place_of_node(n);
    nodes[static_cast<std::size_t>(n)] = {
        0.5 * std::erfc(-x / std::numbers::sqrt2),
        std::exp(-0.5 * x * x) * std::numbers::inv_sqrtpi / std::numbers::sqrt2};
  }
  return nodes;
}

}  // namespace

NormalStep normal_step(double x) {
  static const NormalNodes nodes = computed_nodes();
  if (std::isnan(x)) return {x, x};
  const double inside = std::clamp(x, -kOutermostNode, kOutermostNode);
  // The number is positive: leaving out its fraction rounds to the nearest node.
  const double beyond_node = (inside + kOutermostNode) * kNodesPerUnit + 0.5;
  const int node = static_cast<int>(beyond_node);
  const NormalStep& at = nodes[static_cast<std::size_t>(node)];
  // The density's derivatives are Hermite's polynomials times the density.
  const double from = place_of_node(node), d = inside - from;
  const double first = -from, second = from * from - 1, third = -from * (second - 2);
  return {at.share + at.density * d * (1 + d * (first / 2 + d * second / 6)),
          at.density * (1 + d * (first + d * (second / 2 + d * third / 6)))};
}

}  // namespace orbwatch::align
