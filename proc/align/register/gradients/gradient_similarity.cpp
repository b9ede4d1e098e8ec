// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/gradients/gradient_similarity.h"

#include <algorithm>
#include <array>

#include "proc/align/matrix3.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::Mat3;
using optics::Vec3;

constexpr int kClimbs = 40;

constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Value, slope and curvature at a turn by central differences.
struct Parabola {
  double value;
  Vec3 slope;
  Mat3 curvature;
};

Parabola parabola(const GradientSimilarity& similarity, const Vec3& turn, double step) {
  Parabola p{similarity.at(turn), {}, {{}, {}, {}}};
  std::array<double, 3> high{}, low{};
  for (std::size_t i = 0; i < 3; ++i) {
    high[i] = similarity.at(turn + kAxes[i] * step);
    low[i] = similarity.at(turn - kAxes[i] * step);
    p.slope = p.slope + kAxes[i] * ((high[i] - low[i]) / (2 * step));
    const double along = (high[i] + low[i] - 2 * p.value) / (step * step);
    p.curvature = p.curvature + outer(kAxes[i], kAxes[i]) * along;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 3; ++j) {
      const Vec3 both = (kAxes[i] + kAxes[j]) * step;
      const double mixed = similarity.at(turn + both) + similarity.at(turn - both) - high[i] -
                           low[i] - high[j] - low[j] + 2 * p.value;
      const Mat3 across = outer(kAxes[i], kAxes[j]) + outer(kAxes[j], kAxes[i]);
      p.curvature = p.curvature + across * (mixed / (2 * step * step));
    }
  }
  return p;
}

/// Step to the parabola's top, or uphill where it has none; `step` at most.
Vec3 uphill(const Parabola& p, double step) {
  const Mat3 downwards = p.curvature * -1;
  const Vec3 move = is_positive_definite(downwards) ? inverse(downwards) * p.slope : p.slope * 1e9;
  const double length = norm(move);
  return length > step ? move * (step / length) : move;
}

}  // namespace

template <class Visit>
void GradientSimilarity::visit(const Vec3& turn, const Visit& each) const {
  const Mat3 rotation = rotation_about(turn), back = transposed(rotation);
  for (const GradientField::Sample& sample : samples_) {
    const auto gradient = field_.at(back * sample.direction);
    if (!gradient) continue;
    const double product = dot(rotation * *gradient, sample.gradient);
    each(sample, product * product);
  }
}

double GradientSimilarity::at(const Vec3& turn) const {
  double sum = 0;
  int count = 0;
  visit(turn, [&](const GradientField::Sample&, double similarity) {
    sum += similarity;
    ++count;
  });
  return sum / std::max(count, 1);
}

int GradientSimilarity::agreeing(const Vec3& turn) const {
  int count = 0;
  visit(turn, [&](const GradientField::Sample&, double similarity) {
    count += similarity > 0.4 ? 1 : 0;
  });
  return count;
}

Summit climb(const GradientSimilarity& similarity, const Vec3& start, double step, double least) {
  Vec3 turn = start;
  Parabola here = parabola(similarity, turn, step);
  for (int n = 0; n < kClimbs; ++n) {
    const Vec3 next = turn + uphill(here, step);
    const Parabola there = parabola(similarity, next, step);
    const bool higher = there.value > here.value;
    const bool arrived = !higher || norm(next - turn) < 0.2 * step;
    if (higher) {
      turn = next;
      here = there;
    }
    if (!arrived) continue;
    if (step <= least) break;
    step = std::max(least, step / 2);
    here = parabola(similarity, turn, step);
  }
  return {turn, here.value, here.curvature};
}

}  // namespace orbwatch::align
