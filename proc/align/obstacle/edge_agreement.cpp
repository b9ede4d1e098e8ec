// SPDX-License-Identifier: Apache-2.0
#include "proc/align/obstacle/edge_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "proc/align/detect/picture/luminance.h"
#include "proc/align/register/gradients/gradient_field.h"
#include "proc/align/register/sphere_view.h"
#include "proc/align/register/spiral.h"
#include "proc/optics/scene_proxy.h"

namespace orbwatch::align {
namespace {

using optics::Vec3;

constexpr int kEdgeDirections = 40000;  // over the whole sphere
constexpr double kLevelStep = 0.01;     // closeness
constexpr double kSmoothing = 0.8;      // sigma, degrees
constexpr double kFinestEdgeView = 2;   // pixels per degree

/// The edges of both cameras under the assumption that everything is at one closeness.
class Edges {
 public:
  Edges(const ReferenceCamera& first, const ReferenceCamera& second)
      : first_(first),
        second_(second),
        first_picture_(stretched(luminance_of(first.picture))),
        second_picture_(stretched(luminance_of(second.picture))),
        resolution_(std::min(
            {kFinestEdgeView, best_resolution(first.ball), 1.5 * best_resolution(second.ball)})) {}

  /// above_chance() for each direction; NaN where one of them shows nothing.
  Result<std::vector<float>> agreement(const std::vector<Vec3>& directions,
                                       double closeness) const {
    const auto a = sphere_faces(first_picture_, first_.ball, resolution_, closeness);
    if (!a) return tl::unexpected(a.error());
    const auto b = sphere_faces(second_picture_, second_.ball, resolution_, closeness);
    if (!b) return tl::unexpected(b.error());
    const GradientField first(*a, kSmoothing * resolution_), second(*b, kSmoothing * resolution_);
    std::vector<float> values(directions.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t n = 0; n < directions.size(); ++n) {
      const auto g = first.at(directions[n]), h = second.at(directions[n]);
      if (!g || !h) continue;
      // The mean of cos^2 over all angles is 1/2.
      const double product = dot(*g, *h);
      values[n] = static_cast<float>(product * product - 0.5 * dot(*g, *g) * dot(*h, *h));
    }
    return values;
  }

 private:
  const ReferenceCamera& first_;
  const ReferenceCamera& second_;
  cv::Mat first_picture_;
  cv::Mat second_picture_;
  double resolution_;
};

std::vector<Vec3> downward() {
  std::vector<Vec3> directions;
  for (int n = 0; n < kEdgeDirections; ++n) {
    const Vec3 direction = spiral(n, kEdgeDirections);
    if (direction.z < 0) directions.push_back(direction);
  }
  return directions;
}

std::size_t cell_of(const Vec3& direction) {
  constexpr int kCells = EdgeAgreement::kCells;
  int nearest = 0;
  double best = -2;
  for (int cell = 0; cell < kCells; ++cell) {
    const double cosine = dot(spiral(cell, kCells), direction);
    if (cosine <= best) continue;
    best = cosine;
    nearest = cell;
  }
  return static_cast<std::size_t>(nearest);
}

}  // namespace

Result<EdgeAgreement> EdgeAgreement::measure(const ReferenceCamera& first,
                                             const ReferenceCamera& second,
                                             const optics::Scene& scene) {
  const auto proxy = optics::SceneProxy::make(scene, first.ball.ball());
  if (!proxy) return tl::unexpected(proxy.error());
  const std::vector<Vec3> directions = downward();
  std::vector<double> stated;
  stated.reserve(directions.size());
  for (const Vec3& direction : directions) stated.push_back(proxy->hit(direction).closeness);

  EdgeAgreement out;
  out.farthest_ = *std::ranges::min_element(stated);
  const Edges edges(first, second);
  std::vector<std::vector<float>> levels;
  for (double closeness = out.farthest_; closeness < kClosest + kLevelStep;
       closeness += kLevelStep) {
    auto level = edges.agreement(directions, closeness);
    if (!level) return tl::unexpected(level.error());
    levels.push_back(std::move(*level));
  }
  out.levels_ = levels.size();
  for (std::size_t n = 0; n < directions.size(); ++n) {
    const bool is_shown =
        std::ranges::none_of(levels, [n](const auto& level) { return std::isnan(level[n]); });
    if (!is_shown) continue;
    out.places_.push_back({directions[n], stated[n], cell_of(directions[n])});
    for (const auto& level : levels) out.values_.push_back(level[n]);
  }
  if (out.levels_ < 2 || out.places_.empty()) {
    return fail("the cameras show nothing below the ball in common");
  }
  return out;
}

double EdgeAgreement::above_chance(std::size_t place, double closeness) const {
  const double level =
      std::clamp((closeness - farthest_) / kLevelStep, 0.0, static_cast<double>(levels_) - 1.001);
  const auto below = static_cast<std::size_t>(level);
  const float* const values = values_.data() + place * levels_ + below;
  return std::lerp(static_cast<double>(values[0]), static_cast<double>(values[1]),
                   level - static_cast<double>(below));
}

}  // namespace orbwatch::align
