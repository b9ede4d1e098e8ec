// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/consensus/sightings.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "proc/align/matrix3.h"
#include "proc/align/register/consensus/match_difference.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;
using optics::Vec3;

// Rounds of looking up the turned camera's sights, and turning it again.
constexpr int kTurningRounds = 2;

// Prior for rooms that are not stated.
constexpr RoomCloseness kAnyRoom{0.05, 0.15};
constexpr double kClosest = 0.3;            // greatest closeness assumed in a trial
constexpr double kLeastDepthSpread = 1e-3;  // closeness
const double kExactness = kAgreement / 3;   // tight, as there is no stated wall that may be wrong

/// True if two directions are too near to each other, or to opposite, to determine a rotation.
bool is_narrow(double apart) {
  return apart < kDifferent || apart > optics::radians(180) - kDifferent;
}

/// Sightings through the stated scene, which is looked up anew at each rotation.
class SightingsInScene final : public Sightings {
 public:
  /// `own`: the sought camera in its own frame.
  SightingsInScene(const std::vector<Match>& matches, const BallProjection& reference,
                   const SoughtCamera& sought, const BallProjection& own)
      : sought_(sought), own_(own) {
    for (const Match& match : matches) {
      if (const auto seen = reference.direction(match.reference)) {
        matches_.push_back(match);
        seen_.push_back(*seen);
      }
    }
  }

  std::size_t size() const override { return matches_.size(); }
  const Match& match(std::size_t n) const override { return matches_[n]; }
  int most_trials() const override { return 1500; }

  std::optional<Mat3> hypothesis(const std::array<std::size_t, 2>& chosen) override {
    const double apart = angle_between(seen_[chosen[0]], seen_[chosen[1]]);
    if (is_narrow(apart)) return std::nullopt;
    // Starts far away and in the camera's own frame.
    Mat3 rotation;
    for (int round = 0; round <= kTurningRounds; ++round) {
      const auto ball = round > 0 ? turned_by(rotation) : std::optional(own_);
      if (!ball) return std::nullopt;
      std::array<DirectionPair, 2> pairs;
      for (std::size_t n = 0; n < 2; ++n) {
        const auto direction = towards(*ball, matches_[chosen[n]], round > 0);
        if (!direction) return std::nullopt;
        pairs[n] = {seen_[chosen[n]], transposed(rotation) * *direction};
      }
      const double differs = angle_between(pairs[0].camera, pairs[1].camera) - apart;
      if (round == kTurningRounds && std::abs(differs) > 2 * kAgreement) return std::nullopt;
      rotation = fit_rotation(pairs);
    }
    return rotation;
  }

  std::vector<std::optional<DirectionPair>> pairs(const Mat3& rotation) const override {
    std::vector<std::optional<DirectionPair>> all(matches_.size());
    const auto ball = turned_by(rotation);
    if (!ball) return all;
    for (std::size_t n = 0; n < matches_.size(); ++n) {
      const auto direction = ball->direction(matches_[n].camera);
      if (direction) all[n] = DirectionPair{seen_[n], transposed(rotation) * *direction};
    }
    return all;
  }

  Mat3 fitted(const Mat3& rotation, const std::vector<std::size_t>& inliers) const override {
    const auto all = pairs(rotation);
    std::vector<DirectionPair> agreeing;
    agreeing.reserve(inliers.size());
    for (const std::size_t n : inliers) agreeing.push_back(*all[n]);
    return agreeing.size() < 2 ? rotation : fit_rotation(agreeing);
  }
  double exactness() const override { return kAgreement; }

  std::optional<RoomCloseness> room(const Mat3&, const std::vector<std::size_t>&) const override {
    return std::nullopt;
  }

 private:
  /// nullopt: a camera that is turned like that has no projection.
  std::optional<BallProjection> turned_by(const Mat3& rotation) const {
    const auto ball = turned(sought_, rotation, *sought_.camera.outline);
    return ball ? std::optional(*ball) : std::nullopt;
  }
  static std::optional<Vec3> towards(const BallProjection& ball, const Match& match, bool in_room) {
    if (in_room) return ball.direction(match.camera);
    const auto ray = ball.ray(match.camera);
    return ray ? std::optional(ray->direction) : std::nullopt;
  }

  const SoughtCamera& sought_;
  BallProjection own_;
  std::vector<Match> matches_;
  std::vector<Vec3> seen_;  ///< directions of the reference camera, one per match
};

/// Solves for the small turn that reduces differences most.
class TurnFit {
 public:
  /// `differs`: radians along `way`, across the direction `at`.
  void add(const Vec3& at, const Vec3& way, double differs, double sigma) {
    const Vec3 row = cross(at, way) * (1 / sigma);
    normal_ = normal_ + outer(row, row);
    right_ = right_ + row * (differs / sigma);
  }
  Vec3 turn() const { return inverse(normal_) * right_; }

 private:
  Mat3 normal_;  // starts as the identity, negligible against any match: invertible without one
  Vec3 right_;
};

/// Sightings where no scene is stated: anything may be anywhere along both lines of sight, which
/// turn with the camera.
class SightingsAnywhere final : public Sightings {
 public:
  /// `own`: the sought camera in its own frame.
  SightingsAnywhere(const std::vector<Match>& matches, const BallProjection& reference,
                    const BallProjection& own) {
    for (const Match& match : matches) {
      const auto seen = line_of_sight(reference, match.reference);
      const auto other = line_of_sight(own, match.camera);
      if (!seen || !other) continue;
      matches_.push_back(match);
      lines_.push_back({*seen, *other});
    }
  }

  std::size_t size() const override { return matches_.size(); }
  const Match& match(std::size_t n) const override { return matches_[n]; }
  int most_trials() const override { return 5000; }  // their closeness is guessed, too

  std::optional<Mat3> hypothesis(const std::array<std::size_t, 2>& chosen) override {
    std::array<DirectionPair, 2> pairs;
    for (std::size_t n = 0; n < 2; ++n) {
      const Lines& lines = lines_[chosen[n]];
      const double closeness = any_closeness();
      pairs[n] = {direction_at(lines.reference, closeness), direction_at(lines.camera, closeness)};
    }
    const double apart = angle_between(pairs[0].reference, pairs[1].reference);
    if (is_narrow(apart)) return std::nullopt;
    const double differs = angle_between(pairs[0].camera, pairs[1].camera) - apart;
    if (std::abs(differs) > 2 * kAgreement) return std::nullopt;
    return fit_rotation(pairs);
  }

  std::vector<std::optional<DirectionPair>> pairs(const Mat3& rotation) const override {
    std::vector<std::optional<DirectionPair>> all;
    for (const Lines& lines : lines_) {
      const double closeness = met(lines, rotation).closeness;
      all.emplace_back(DirectionPair{direction_at(lines.reference, closeness),
                                     direction_at(lines.camera, closeness)});
    }
    return all;
  }

  /// A Gauss-Newton step from the differences across the parallax and, with much less weight, along
  /// it.
  Mat3 fitted(const Mat3& rotation, const std::vector<std::size_t>& inliers) const override {
    TurnFit fit;
    for (const std::size_t n : inliers) {
      const Meeting here = met(lines_[n], rotation);
      const Vec3 at = direction_at(lines_[n].reference, here.closeness);
      const double steepness = norm(here.slope);
      const Vec3 along = here.slope * (1 / std::max(steepness, 1e-9));
      const Vec3 across = cross(at, along);
      fit.add(at, across, dot(here.apart, across), kExactness);
      const double to_mean = steepness * (here.closeness - kAnyRoom.mean);
      fit.add(at, along, dot(here.apart, along) - to_mean,
              std::hypot(kExactness, kAnyRoom.spread * steepness));
    }
    return rotation_about(fit.turn()) * rotation;
  }
  double exactness() const override { return kExactness; }

  std::optional<RoomCloseness> room(const Mat3& rotation,
                                    const std::vector<std::size_t>& inliers) const override {
    if (inliers.empty()) return kAnyRoom;
    std::vector<double> all;
    all.reserve(inliers.size());
    for (const std::size_t n : inliers) all.push_back(met(lines_[n], rotation).closeness);
    const double mean = median(all);
    for (double& one : all) one = std::abs(one - mean);
    return RoomCloseness{mean, std::max(kLeastDepthSpread, median(all) / 0.6745)};
  }

 private:
  struct Lines {
    LineOfSight reference;
    LineOfSight camera;
  };

  /// Random closeness; far more often than near.
  double any_closeness() {
    const double share = std::uniform_real_distribution<double>(0, 1)(random_);
    return kClosest * share * share;
  }

  static Meeting met(const Lines& lines, const Mat3& rotation) {
    return meeting(lines.reference, align::turned(lines.camera, rotation), kExactness, kAnyRoom);
  }

  std::vector<Match> matches_;
  std::vector<Lines> lines_;
  std::mt19937_64 random_{2};
};

}  // namespace

Result<std::unique_ptr<Sightings>> make_sightings(const std::vector<Match>& matches,
                                                  const BallProjection& reference,
                                                  const SoughtCamera& sought) {
  return in_own_frame(sought).map([&](const BallProjection& own) -> std::unique_ptr<Sightings> {
    if (states_scene(sought.rig)) {
      return std::make_unique<SightingsInScene>(matches, reference, sought, own);
    }
    return std::make_unique<SightingsAnywhere>(matches, reference, own);
  });
}

}  // namespace orbwatch::align
