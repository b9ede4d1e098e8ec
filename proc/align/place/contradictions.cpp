#include "proc/align/place/contradictions.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace orbwatch::align {
namespace {

constexpr double kFalseAlarms = 1e-4;  ///< of requests without a mistake

/// How much the sum of squares falls without this mark; 0 when it cannot be tested.
double drop(const Equations& equations, const Eigen::MatrixXd& covariance, std::size_t mark) {
  const Eigen::Index row = 2 * Eigen::Index(mark);
  const Eigen::MatrixXd slopes = equations.jacobian.middleRows(row, 2);
  const Eigen::Vector2d residual = equations.residuals.segment<2>(row);
  const Eigen::Matrix2d free =
      Eigen::Matrix2d::Identity() - slopes * covariance * slopes.transpose();
  // Each eigenvalue is the share of a mistake that the other equations show.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(free);
  constexpr double kTestable = 1e-4;
  double sum = 0;
  for (int k = 0; k < 2; ++k) {
    const double share = solver.eigenvalues()[k];
    const double along = solver.eigenvectors().col(k).dot(residual);
    if (share > kTestable) sum += along * along / share;
  }
  return sum;
}

}  // namespace

std::optional<Contradiction> contradiction(const Equations& equations,
                                           const Eigen::MatrixXd& covariance, std::size_t marks) {
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
  constexpr double kNormal = 3.719;  // exceeded once in 10000 times
  const double share = 2.0 / (9 * degrees_of_freedom);
  return degrees_of_freedom * std::pow(1 - share + kNormal * std::sqrt(share), 3);
}

}  // namespace orbwatch::align
