// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "proc/align/register/registration.h"

namespace orbwatch::app {
namespace {

using optics::Vec2;
using optics::Vec3;

/// Pieces of an edge, so that lines of pixels bend as the ball bends them.
constexpr int kPieces = 32;
/// An edge lies on the surfaces that it bounds.
constexpr double kSameCloseness = 1.001;

/// Nullopt: something hides it, or the ball does not show it.
std::optional<Vec2> seen_at(const optics::BallProjection& ball, const Vec3& point) {
  const double closeness = 1 / norm(point);
  const Vec3 direction = normalized(point);
  if (ball.proxy().hit(direction).closeness > kSameCloseness * closeness) return std::nullopt;
  return ball.pixel(direction, closeness);
}

/// Both ends in ball radii, as SceneProxy has them.
void add_edge(const optics::BallProjection& ball, const Vec3& from, const Vec3& to,
              std::vector<SceneEdge>& edges) {
  const double radius = ball.ball().radius;
  SceneEdge shown;
  const auto end_it = [&] {
    if (shown.pixels.size() > 1) edges.push_back(std::move(shown));
    shown = {};
  };
  for (int n = 0; n <= kPieces; ++n) {
    const Vec3 point = from + (to - from) * (double(n) / kPieces);
    const auto pixel = seen_at(ball, point);
    if (!pixel) {
      end_it();
      continue;
    }
    if (shown.pixels.empty()) shown.from = point * radius;
    shown.to = point * radius;
    shown.pixels.push_back(*pixel);
  }
  end_it();
}

/// Adds an end of an edge, in ball radii, unless another edge has added it.
void add_corner(const optics::BallProjection& ball, const Vec3& end,
                std::vector<SceneCorner>& corners) {
  constexpr double kSame = 1e-6;  // ball radii
  const double radius = ball.ball().radius;
  const Vec3 point = ball.ball().centre + end * radius;
  const auto is_it = [&](const SceneCorner& one) {
    return norm(one.point - point) < kSame * radius;
  };
  if (std::ranges::any_of(corners, is_it)) return;
  if (const auto pixel = seen_at(ball, end)) corners.push_back({point, *pixel});
}

}  // namespace

Result<CameraAlignmentState> alignment_state(const optics::Rig& rig,
                                             const optics::RigCamera& camera) {
  const auto ball = optics::ball_projection(rig, camera);
  if (!ball) return tl::unexpected(ball.error());
  const auto seen = align::by_outline(rig, camera);
  if (!seen) return tl::unexpected(seen.error());
  CameraAlignmentState state;
  state.outline = *seen->outline;
  state.rotation = optics::yaw_pitch_roll(seen->registration);
  if (std::isfinite(ball->distance())) {
    state.position =
        ball->ball().centre + ball->facing() * (ball->distance() * ball->ball().radius);
  }
  for (const auto& [from, to] : ball->proxy().edges()) {
    add_edge(*ball, from, to, state.edges);
    add_corner(*ball, from, state.corners);
    add_corner(*ball, to, state.corners);
  }
  return state;
}

std::optional<CameraAlignmentState> alignment_in_force(const AlignedSite& site,
                                                       std::size_t camera) {
  const optics::RigCamera& own = site.rig_camera(camera);
  auto state = alignment_state(site.rig, own);
  if (!state) return std::nullopt;
  for (const CalibrationEntry& entry : site.alignments) {
    if (camera_of(entry).camera != own.name) continue;
    state->number = entry.number;
    state->method = entry.method;
    state->quality = entry.quality;
  }
  return std::move(*state);
}

}  // namespace orbwatch::app
