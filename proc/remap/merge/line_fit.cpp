// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/line_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace orbwatch::remap {
namespace {

constexpr std::size_t kFewest = 8;
constexpr int kRounds = 20;
constexpr double kLeastSpread = 0.05;
constexpr double kLeastCorrelation = 0.5;
/// Tukey's constant: 95 % efficiency for normal errors.
constexpr double kTukey = 4.685;
/// Standard deviation of a normal distribution per median absolute deviation.
constexpr double kPerMedianDeviation = 1.4826;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Weighted means and second moments about them.
struct Moments {
  double weight = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

  double correlation() const { return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0; }
  bool is_flat() const {
    return std::sqrt(xx / weight) < kLeastSpread * x || std::sqrt(yy / weight) < kLeastSpread * y;
  }
};

Moments moments(std::span<const Measured> measured, std::span<const double> trust) {
  Moments m;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double w = measured[i].weight * trust[i];
    m.weight += w;
    m.x += w * measured[i].x;
    m.y += w * measured[i].y;
  }
  m.x /= m.weight;
  m.y /= m.weight;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double w = measured[i].weight * trust[i];
    const double dx = measured[i].x - m.x, dy = measured[i].y - m.y;
    m.xx += w * dx * dx;
    m.yy += w * dy * dy;
    m.xy += w * dx * dy;
  }
  return m;
}

/// Theil's incomplete method: each measurement of the lower half with its partner in the upper one.
Line first_guess(std::span<Measured> measured) {
  std::sort(measured.begin(), measured.end(),
            [](const Measured& a, const Measured& b) { return a.x < b.x; });
  std::vector<double> values;
  const std::size_t half = measured.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    const Measured &a = measured[i], &b = measured[i + measured.size() - half];
    if (b.x > a.x) values.push_back((b.y - a.y) / (b.x - a.x));
  }
  Line line;
  line.slope = values.empty() ? 0 : median(values);
  values.clear();
  for (const Measured& m : measured) values.push_back(m.y - line.slope * m.x);
  line.offset = median(values);
  return line;
}

/// Tukey's biweight of every residual, scaled by the residuals' median deviation.
void update_trust(std::span<const Measured> measured, const Line& line, std::span<double> trust) {
  std::vector<double> sizes;
  double largest_y = 0;
  for (const Measured& m : measured) {
    sizes.push_back(std::abs(m.y - line.slope * m.x - line.offset));
    largest_y = std::max(largest_y, std::abs(m.y));
  }
  // The scale is the rounding error if there is no noise at all.
  const double scale = kTukey * std::max(kPerMedianDeviation * median(sizes), 1e-9 * largest_y);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double residual = measured[i].y - line.slope * measured[i].x - line.offset;
    const double t = std::abs(residual) < scale ? 1 - std::pow(residual / scale, 2) : 0;
    trust[i] = t * t;
  }
}

}  // namespace

std::optional<Line> fit_line(std::span<Measured> measured) {
  if (measured.size() < kFewest) return std::nullopt;
  Line line = first_guess(measured);
  std::vector<double> trust(measured.size(), 1.0);
  Moments m;
  for (int round = 0; round < kRounds; ++round) {
    update_trust(measured, line, trust);
    m = moments(measured, trust);
    if (!(m.weight > 0)) return std::nullopt;
    const bool through_origin = m.is_flat();
    if (through_origin && !(m.x > 0 && m.y > 0)) return std::nullopt;
    if (!through_origin && m.correlation() < kLeastCorrelation) return std::nullopt;
    line.slope = through_origin ? m.y / m.x : std::sqrt(m.yy / m.xx);
    line.offset = m.y - line.slope * m.x;
  }
  line.mean_x = m.x;
  line.mean_y = m.y;
  line.weight = m.weight;
  return line;
}

}  // namespace orbwatch::remap
