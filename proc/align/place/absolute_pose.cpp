// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/absolute_pose.h"

#include <algorithm>
#include <cmath>

#include "proc/align/matrix3.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::Mat3;
using optics::Ray;
using optics::Vec3;

/// Angle from which on a point is an outlier, whatever its distance: 0.05 rad, a slip of the hand.
constexpr double kLimit = 0.05;

/// Directions from the ball's centre to one point, in both frames.
struct Pair {
  Vec3 machine;
  Vec3 camera;
};

/// The direction to the ray's point at that distance from the ball's centre; the ray begins at
/// distance 1.
Vec3 at_distance(const Ray& ray, double distance) {
  const double along = dot(ray.origin, ray.direction);
  const double way = -along + std::sqrt(along * along + distance * distance - 1);
  return normalized(ray.origin + ray.direction * way);
}

std::vector<Pair> pairs_around(const std::vector<PointSight>& sights, const Vec3& centre) {
  std::vector<Pair> pairs;
  for (const PointSight& sight : sights) {
    const Vec3 offset = sight.point - centre;
    const double distance = norm(offset);
    if (!(distance > 1)) continue;
    pairs.push_back({offset * (1 / distance), at_distance(sight.ray, distance)});
  }
  return pairs;
}

/// The weighted rotation that turns the machine's directions into the camera's.
Mat3 fit_rotation(const std::vector<Pair>& pairs, const std::vector<double>& weights) {
  std::vector<DirectionPair> directions;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    directions.push_back({pairs[n].camera, pairs[n].machine, weights[n]});
  }
  return fit_rotation(directions);
}

double angle2(const Pair& pair, const Mat3& rotation) {
  const Vec3 off = rotation * pair.machine - pair.camera;
  return dot(off, off);
}

double badness(const std::vector<Pair>& pairs, const Mat3& rotation) {
  double sum = 0;
  for (const Pair& pair : pairs) sum += std::min(angle2(pair, rotation), kLimit * kLimit);
  return sum;
}

/// Weight near 1 for small angles, near 0 for large ones (Geman and McClure).
double trust(double squared_angle) {
  const double share = 1 / (1 + squared_angle / (kLimit * kLimit));
  return share * share;
}

Mat3 improved(const std::vector<Pair>& pairs, Mat3 rotation) {
  std::vector<double> weights(pairs.size());
  for (int round = 0; round < 5; ++round) {
    for (std::size_t n = 0; n < pairs.size(); ++n) weights[n] = trust(angle2(pairs[n], rotation));
    rotation = fit_rotation(pairs, weights);
  }
  return rotation;
}

/// The ball's centre in camera axes, R C, for which the points, turned by `rotation`, lie on their
/// rays; each is weighted by the angle that it subtends and, with `by_trust`, by its trust at
/// `last`.
std::optional<Vec3> turned_centre(const std::vector<PointSight>& sights, const Mat3& rotation,
                                  const Vec3& last, bool by_trust) {
  Mat3 normal{{}, {}, {}};
  Vec3 right_side;
  for (const PointSight& sight : sights) {
    const Vec3& d = sight.ray.direction;
    const auto across = [&d](const Vec3& v) { return v - d * dot(d, v); };
    const Vec3 from_origin = rotation * sight.point - sight.ray.origin;
    const Vec3 left = from_origin - last, off = across(left);
    const double distance2 = std::max(dot(left, left), 1.0);
    const double weight = (by_trust ? trust(dot(off, off) / distance2) : 1) / distance2;
    normal = normal + (Mat3{} + outer(d, d) * -1) * weight;
    right_side = right_side + weight * across(from_origin);
  }
  constexpr double kMostCondition = 1e9;
  const Mat3 inverted = inverse(normal);
  if (!(frobenius_norm(normal) * frobenius_norm(inverted) < kMostCondition)) return std::nullopt;
  return inverted * right_side;
}

}  // namespace

std::optional<Attitude> attitude_around(const std::vector<PointSight>& sights, const Vec3& centre) {
  const std::vector<Pair> pairs = pairs_around(sights, centre);
  if (pairs.size() < 2) return std::nullopt;
  // A few hundred pairs suffice to include one without a mistake.
  const std::size_t stride = 1 + pairs.size() / 24;
  std::optional<Attitude> best;
  for (std::size_t a = 0; a < pairs.size(); a += stride) {
    for (std::size_t b = a + 1; b < pairs.size(); b += stride) {
      const Mat3 rotation = fit_rotation({pairs[a], pairs[b]}, {1, 1});
      const double bad = badness(pairs, rotation);
      if (!best || bad < best->badness) best = Attitude{rotation, bad};
    }
  }
  const Mat3 rotation = improved(pairs, best->rotation);
  const double bad = badness(pairs, rotation);
  if (bad < best->badness) best = Attitude{rotation, bad};
  // Points within the ball count as outliers.
  best->badness += double(sights.size() - pairs.size()) * kLimit * kLimit;
  return best;
}

std::optional<FreePose> free_pose(const std::vector<PointSight>& sights, const Vec3& guess) {
  constexpr int kRounds = 40;
  Vec3 centre = guess;
  Mat3 rotation;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Pair> pairs = pairs_around(sights, centre);
    if (pairs.size() < 3) return std::nullopt;
    // All points have equal weight at first: the guess is far off for each of them.
    const bool by_trust = round >= kRounds / 2;
    rotation = by_trust ? improved(pairs, rotation)
                        : fit_rotation(pairs, std::vector<double>(pairs.size(), 1));
    const auto next = turned_centre(sights, rotation, rotation * centre, by_trust);
    if (!next) return std::nullopt;
    centre = transposed(rotation) * *next;
  }
  const std::vector<Pair> pairs = pairs_around(sights, centre);
  if (pairs.size() < 3) return std::nullopt;
  const double inside = double(sights.size() - pairs.size()) * kLimit * kLimit;
  return FreePose{centre, badness(pairs, rotation) + inside};
}

}  // namespace orbwatch::align
