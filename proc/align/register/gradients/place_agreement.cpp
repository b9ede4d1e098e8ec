// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/gradients/place_agreement.h"

#include <algorithm>
#include <numeric>

#include "proc/optics/resolution.h"

namespace orbwatch::align {
namespace {

using optics::Vec3;

// Variance of an error in relation to what the parts of the sphere, taken as independent, tell: a
// thing that the scene does not state shifts edges in several parts. From 20 simulated rooms.
constexpr double kCommon = 2.4;
// Resolution at which the error of a pixel shifts an edge as much as what the scene does not state,
// px per degree.
constexpr double kSceneBound = 0.2;

/// Weight of an edge, 0 to 1: the inverse of its variance, which is constant where the scene bounds
/// it and follows the resolution where the picture does. `resolution`: px per degree.
double edge_weight(double resolution) {
  const double square = resolution * resolution;
  return square / (square + kSceneBound * kSceneBound);
}

PlaceChange along(int unknown, double step) {
  PlaceChange change;
  change[unknown] = step;
  return change;
}

Vec3 shift(const PlaceShifts::Shifts& shifts, const PlaceChange& change) {
  Vec3 sum;
  for (int n = 0; n < kPlaceUnknowns; ++n) {
    sum = sum + shifts[static_cast<std::size_t>(n)] * change[n];
  }
  return sum;
}

}  // namespace

PlaceAgreement::PlaceAgreement(const std::vector<GradientField::Sample>& samples,
                               const PlaceShifts& shifts, const GradientField& field)
    : field_(field) {
  for (const GradientField::Sample& sample : samples) {
    const double weight = edge_weight(optics::resolution(shifts.ball(), sample.direction));
    if (const auto shifted = shifts.at(sample.direction)) {
      edges_.push_back({sample, *shifted, weight});
    }
  }
}

template <class Visit>
double PlaceAgreement::visit(const PlaceChange& change, const Visit& each) const {
  double weights = 0;
  for (const Edge& edge : edges_) {
    const Vec3& direction = edge.sample.direction;
    const auto gradient = field_.at(optics::normalized(direction + shift(edge.shifts, change)));
    if (!gradient) continue;
    const double product = dot(*gradient, edge.sample.gradient);
    each(edge, edge.weight * product * product);
    weights += edge.weight;
  }
  return weights;
}

std::array<double, GradientField::kParts> PlaceAgreement::parts(const PlaceChange& change) const {
  std::array<double, GradientField::kParts> sums{};
  const double weights = visit(
      change, [&](const Edge& edge, double similarity) { sums[edge.sample.part] += similarity; });
  if (!(weights > 0)) return {};
  for (double& sum : sums) sum /= weights;
  return sums;
}

double PlaceAgreement::at(const PlaceChange& change) const {
  const auto all = parts(change);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

PlaceAgreement::Slope PlaceAgreement::slope(const PlaceChange& change, double step) const {
  std::array<PlaceChange, GradientField::kParts> slopes{};
  for (int n = 0; n < kPlaceUnknowns; ++n) {
    const auto high = parts(change + along(n, step)), low = parts(change - along(n, step));
    for (std::size_t part = 0; part < slopes.size(); ++part) {
      slopes[part][n] = (high[part] - low[part]) / (2 * step);
    }
  }
  Slope slope;
  int used = 0;
  for (const PlaceChange& one : slopes) {
    slope.sum += one;
    slope.covariance += one * one.t();
    used += cv::norm(one) > 0 ? 1 : 0;
  }
  // The unknowns are fitted to the same parts.
  slope.covariance *= kCommon * used / std::max(1.0, static_cast<double>(used - kPlaceUnknowns));
  return slope;
}

Result<PlaceCovariance> PlaceAgreement::normal_matrix(double step) const {
  PlaceCovariance sum;
  visit({}, [&](const Edge& edge, double similarity) {
    const Vec3 normal = optics::normalized(edge.sample.gradient);
    PlaceChange across;
    for (int n = 0; n < kPlaceUnknowns; ++n) {
      across[n] = dot(edge.shifts[static_cast<std::size_t>(n)], normal);
    }
    sum += across * across.t() * similarity;
  });
  const double here = at({});
  double bend = 0, trace = 0;
  for (int n = 0; n < 3; ++n) {
    bend += (2 * here - at(along(n, step)) - at(along(n, -step))) / (step * step);
    trace += sum(n, n);
  }
  if (!(bend > 0 && trace > 0)) return fail("the edges do not determine the rotation");
  return sum * (bend / trace);
}

}  // namespace orbwatch::align
