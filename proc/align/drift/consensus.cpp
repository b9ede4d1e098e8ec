// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/consensus.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace orbwatch::align {
namespace {

using optics::Vec2;

/// A patch's least error, px, and the share of its way that it may be off because reflections do
/// not quite move with the limb when the ball moves.
constexpr double kNoiseFloor = 0.05, kOwnWay = 0.05;
/// Squared residuals in standard deviations, from the widest to the last.
constexpr std::array kWidths{400.0, 100.0, 30.0, 12.0, 12.0, 12.0};
/// Prior standard deviation of growth and roll.
constexpr double kPrior = 0.05;
constexpr double kBetter = 1.2;
/// Weight from which on a patch agrees.
constexpr double kAgrees = 0.25;

/// The upper median; reorders the list.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Fit {
 public:
  Fit(const Sighting& sighting, double radius) : sighting_(sighting), radius_(radius) {
    weights_.reserve(sighting.found.size());
    for (const auto& [arm, shift] : sighting.found) {
      const double floor = kNoiseFloor + kOwnWay * std::hypot(shift.shift.u, shift.shift.v);
      const cv::Matx22d& information = shift.information;
      weights_.push_back((cv::Matx22d::eye() + information * (floor * floor)).inv() * information);
    }
  }

  Consensus from(PictureMotion motion) const {
    for (const double width : kWidths) motion = improved(motion, width);
    Consensus result{motion, 0, sighting_.expected - sighting_.saturated, 0};
    std::bitset<8> octants;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const double weight = agreement(i, motion, kWidths.back());
      result.agreeing += weight;
      const Vec2& arm = sighting_.found[i].arm;
      const double turn = (std::atan2(arm.v, arm.u) / std::numbers::pi + 1) / 2;
      if (weight > kAgrees) octants.set(static_cast<std::size_t>(std::min(turn * 8, 7.0)));
    }
    result.octants = static_cast<int>(octants.count());
    return result;
  }

  PictureMotion median_shift() const {
    std::vector<double> u, v;
    for (const auto& [arm, shift] : sighting_.found) {
      u.push_back(shift.shift.u);
      v.push_back(shift.shift.v);
    }
    return {median(u), median(v), 0, 0};
  }

 private:
  cv::Vec2d residual(std::size_t i, const PictureMotion& motion) const {
    const auto& [arm, shift] = sighting_.found[i];
    const Vec2 way = motion.at(arm);
    return {shift.shift.u - way.u, shift.shift.v - way.v};
  }

  /// Weight of a patch: 1 if it agrees, towards 0 if not.
  double agreement(std::size_t i, const PictureMotion& motion, double width) const {
    const cv::Vec2d r = residual(i, motion);
    const double root = 1 / (1 + r.dot(weights_[i] * r) / width);
    return root * root;
  }

  PictureMotion improved(const PictureMotion& motion, double width) const {
    cv::Matx44d normal = cv::Matx44d::diag({1e-6, 1e-6, 0, 0});
    normal(2, 2) = normal(3, 3) = 1 / (kPrior * kPrior * radius_ * radius_);
    cv::Vec4d right(0, 0, -motion.growth * radius_ * normal(2, 2),
                    -motion.roll * radius_ * normal(3, 3));
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const Vec2& arm = sighting_.found[i].arm;
      const cv::Matx<double, 2, 4> design(1, 0, arm.u / radius_, -arm.v / radius_,  //
                                          0, 1, arm.v / radius_, arm.u / radius_);
      const cv::Matx22d weight = weights_[i] * agreement(i, motion, width);
      const cv::Matx<double, 4, 2> weighted = design.t() * weight;
      normal += weighted * design;
      right += weighted * residual(i, motion);
    }
    const cv::Vec4d step = normal.solve(right, cv::DECOMP_CHOLESKY);
    return motion + PictureMotion{step[0], step[1], step[2] / radius_, step[3] / radius_};
  }

  const Sighting& sighting_;
  double radius_;
  /// Information of the shifts, the patches' expected errors included.
  std::vector<cv::Matx22d> weights_;
};

}  // namespace

Consensus consensus(const Sighting& sighting, std::span<const PictureMotion> starts,
                    double radius) {
  Consensus best;
  best.expected = sighting.expected - sighting.saturated;
  if (sighting.found.empty()) return best;
  const Fit fit(sighting, radius);
  bool is_first = true;
  const auto consider = [&](const PictureMotion& start) {
    const Consensus other = fit.from(start);
    if (is_first || other.agreeing > kBetter * best.agreeing) best = other;
    is_first = false;
  };
  for (const PictureMotion& start : starts) consider(start);
  // When nearly all patches agree, no other motion can have a fifth more.
  if (static_cast<double>(sighting.found.size()) > kBetter * best.agreeing) {
    consider(fit.median_shift());
  }
  return best;
}

}  // namespace orbwatch::align
