// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "proc/align/place/absolute_pose.h"

namespace orbwatch::align {
namespace {

using optics::Vec3;

constexpr std::size_t kStarts = 4;
/// Centres found by single cameras that are tried with all cameras.
constexpr std::size_t kCentres = 12;

/// A camera with one focal length, and its sights without a pose.
struct Sighted {
  double log_focal = 0;
  Vec3 ball;                       ///< camera frame, ball radii
  std::vector<PointSight> sights;  ///< one per mark
};

/// A pixel that the ball shows in any case: a mark next to the limb may lie outside by its error.
optics::Vec2 well_inside(const optics::Outline& outline, const optics::Vec2& pixel) {
  constexpr double kMostRelative = 0.99;
  const double relative = optics::relative_distance(outline, pixel);
  if (relative <= kMostRelative) return pixel;
  const optics::Vec2& centre = outline.centre;
  const double scale = kMostRelative / relative;
  return {centre.u + (pixel.u - centre.u) * scale, centre.v + (pixel.v - centre.v) * scale};
}

/// nullopt if the outline is not a ball's with this focal length.
std::optional<Sighted> sighted(const PlaceRequest& request, const UnplacedCamera& camera,
                               double log_focal) {
  const auto lens = lens_at(camera, log_focal);
  if (!lens) return std::nullopt;
  const auto sight = optics::sight_from_outline(camera.outline, *lens);
  if (!sight) return std::nullopt;
  const Vec3 ball = sight->axis * sight->distance;
  const auto picture = optics::BallProjection::make(optics::BallModel::Kind::Exact,
                                                    {*lens, {}, std::nullopt}, {ball, 1});
  if (!picture) return std::nullopt;
  Sighted all{log_focal, ball, {}};
  for (const PointMark& mark : camera.marks) {
    const auto ray = picture->ray(well_inside(camera.outline, mark.pixel));
    if (!ray) return std::nullopt;
    all.sights.push_back({request.points[mark.point] * (1 / request.ball_radius),
                          {ray->origin - ball, ray->direction}});
  }
  return all;
}

std::vector<Sighted> sighted(const PlaceRequest& request, const UnplacedCamera& camera) {
  // Lenses from very wide to very long, relative to the request's.
  constexpr int kFocals = 16;
  constexpr double kWidest = 0.35, kLongest = 12;
  std::vector<Sighted> all;
  const int count = camera.focal_unknown ? kFocals : 1;
  for (int n = 0; n < count; ++n) {
    const double log_focal =
        count == 1 ? 0 : std::log(kWidest) + std::log(kLongest / kWidest) * n / (count - 1);
    if (auto one = sighted(request, camera, log_focal)) all.push_back(*one);
  }
  return all;
}

/// The points' bounding box, as centre and half sides, in ball radii.
std::pair<Vec3, Vec3> bounds(const PlaceRequest& request) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3 low{kFar, kFar, kFar}, high = -low;
  for (const Vec3& p : request.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double scale = 0.5 / request.ball_radius;
  return {(low + high) * scale, (high - low) * scale};
}

/// Places all over the points' surroundings, in steps of their longest side: points may lie in a
/// plane.
std::vector<Vec3> centres_around(const PlaceRequest& request) {
  constexpr std::array kSteps{-1.6, -0.8, 0.0, 0.8, 1.6};
  const auto [middle, half] = bounds(request);
  const double size = std::max({half.x, half.y, half.z});
  std::vector<Vec3> all;
  for (const double x : kSteps) {
    for (const double y : kSteps) {
      for (const double z : kSteps) all.push_back(middle + Vec3{x, y, z} * size);
    }
  }
  return all;
}

struct Start {
  double badness = 0;
  PlaceState state;
};

/// All cameras around one centre, each with its best focal length.
Start around(const PlaceRequest& request, const std::vector<std::vector<Sighted>>& cameras,
             const Vec3& centre) {
  Start start;
  start.state.centre = centre;
  for (const Vec3& p : request.points) start.state.points.push_back(p * (1 / request.ball_radius));
  for (const auto& choices : cameras) {
    double least = std::numeric_limits<double>::infinity();
    CameraState best;
    for (const Sighted& sighted : choices) {
      const auto attitude = attitude_around(sighted.sights, centre);
      if (!attitude || !(attitude->badness < least)) continue;
      least = attitude->badness;
      best = {attitude->rotation, sighted.ball, sighted.log_focal};
    }
    start.badness += least;
    start.state.cameras.push_back(best);
  }
  return start;
}

/// The best centres for each single camera.
std::vector<Vec3> likely_centres(const PlaceRequest& request,
                                 const std::vector<std::vector<Sighted>>& cameras) {
  std::vector<FreePose> found;
  const auto guesses = centres_around(request);
  for (const auto& choices : cameras) {
    for (const Sighted& sighted : choices) {
      for (const Vec3& guess : guesses) {
        if (auto pose = free_pose(sighted.sights, guess)) found.push_back(*pose);
      }
    }
  }
  std::ranges::sort(found, {}, &FreePose::badness);
  std::vector<Vec3> distinct;
  for (const FreePose& pose : found) {
    const auto is_near = [&](const Vec3& c) { return norm(c - pose.centre) < 0.1; };
    if (std::ranges::any_of(distinct, is_near)) continue;
    distinct.push_back(pose.centre);
    if (distinct.size() == kCentres) break;
  }
  return distinct;
}

}  // namespace

std::vector<PlaceState> starts(const PlaceRequest& request) {
  std::vector<std::vector<Sighted>> cameras;
  for (const UnplacedCamera& camera : request.cameras) {
    cameras.push_back(sighted(request, camera));
  }
  const bool unknown = request.centre.knowledge == BallCentre::Knowledge::Unknown;
  const std::vector<Vec3> centres =
      unknown ? likely_centres(request, cameras)
              : std::vector{request.centre.position * (1 / request.ball_radius)};
  std::vector<Start> all;
  for (const Vec3& centre : centres) {
    Start start = around(request, cameras, centre);
    if (std::isfinite(start.badness)) all.push_back(std::move(start));
  }
  std::ranges::sort(all, {}, &Start::badness);
  std::vector<PlaceState> best;
  for (std::size_t n = 0; n < std::min(all.size(), kStarts); ++n) best.push_back(all[n].state);
  return best;
}

}  // namespace orbwatch::align
