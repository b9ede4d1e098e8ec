#include "app/watch/alignment_state.h"

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

void add_edge(const optics::BallProjection& ball, const Vec3& from, const Vec3& to,
              std::vector<std::vector<Vec2>>& lines) {
  std::vector<Vec2> line;
  const auto end_line = [&] {
    if (line.size() > 1) lines.push_back(std::move(line));
    line.clear();
  };
  for (int n = 0; n <= kPieces; ++n) {
    const auto pixel = seen_at(ball, from + (to - from) * (double(n) / kPieces));
    if (pixel) {
      line.push_back(*pixel);
    } else {
      end_line();
    }
  }
  end_line();
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
  for (const auto& [from, to] : ball->proxy().edges()) add_edge(*ball, from, to, state.edges);
  return state;
}

}  // namespace orbwatch::app
