// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/contradictions.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace orbwatch::align {
namespace {

constexpr double kFalseAlarms = 1e-4;  ///< share of requests without a mistake

/// Decrease of the sum of squares without this mark; 0 when it cannot be tested.
double drop(const Equations& equations, const cv::Mat1d& covariance, std::size_t mark) {
  const int row = 2 * int(mark);
  const cv::Mat1d slopes = equations.jacobian.rowRange(row, row + 2);
  const cv::Vec2d residual(&equations.residuals[std::size_t(row)]);
  const cv::Mat1d free = cv::Mat1d::eye(2, 2) - slopes * covariance * slopes.t();
  // Each eigenvalue is the share of a mistake that the other equations show.
  cv::Vec2d shares;
  cv::Matx22d directions;  // one per row
  cv::eigen(free, shares, directions);
  constexpr double kTestable = 1e-4;
  double sum = 0;
  for (int k = 0; k < 2; ++k) {
    const double along = directions.row(k).dot(residual.t());
    if (shares[k] > kTestable) sum += along * along / shares[k];
  }
  return sum;
}

}  // namespace

std::optional<Contradiction> contradiction(const Equations& equations, const cv::Mat1d& covariance,
                                           std::size_t marks) {
  std::vector<double> drops;
  for (std::size_t n = 0; n < marks; ++n) drops.push_back(drop(equations, covariance, n));
  const auto worst = std::ranges::max_element(drops);
  if (worst == drops.end()) return std::nullopt;
  // The tail of chi-square with two degrees of freedom is exp(-x / 2).
  const double limit = 2 * std::log(double(marks) / kFalseAlarms);
  if (!(*worst > limit)) return std::nullopt;
  Contradiction found{std::size_t(worst - drops.begin()), std::nullopt};
  for (std::size_t n = 0; n < marks; ++n) {
    if (n != found.used && drops[n] > *worst - limit / 2) found.rival = n;
  }
  return found;
}

double chi_square_limit(int degrees_of_freedom) {
  constexpr double kNormal = 3.719;  // quantile exceeded once in 10000 times
  const double share = 2.0 / (9 * degrees_of_freedom);
  return degrees_of_freedom * std::pow(1 - share + kNormal * std::sqrt(share), 3);
}

}  // namespace orbwatch::align
