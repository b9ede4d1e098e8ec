// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/registration.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "proc/align/register/spiral.h"
#include "proc/optics/lens.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;
using optics::Outline;
using optics::Vec3;

constexpr double kLeastOverlap = 0.2;
constexpr double kWidestSigma = 0.5;  // degrees

std::string rounded(double value) {
  std::ostringstream text;
  text << std::setprecision(2) << value;
  return text.str();
}

}  // namespace

bool states_scene(const optics::Rig& rig) {
  return rig.scene.room != optics::Scene::Room::None || !rig.scene.obstacles.empty();
}

std::array<double, 3> sigmas(const Registration& r) {
  return {optics::degrees(std::sqrt(r.covariance.row0.x)),
          optics::degrees(std::sqrt(r.covariance.row1.y)),
          optics::degrees(std::sqrt(r.covariance.row2.z))};
}

double direction_sigma(const Registration& r) {
  // A turn t moves the direction d by t x d, which is |t|^2 2/3 squared on average over d.
  const double trace = r.covariance.row0.x + r.covariance.row1.y + r.covariance.row2.z;
  return optics::degrees(std::sqrt(2 * trace / 3));
}

Mat3 registration_of(const Mat3& pose_rotation) {
  return transposed(Mat3{-pose_rotation.row0, -pose_rotation.row2, -pose_rotation.row1});
}

Result<optics::RigCamera> by_outline(const optics::Rig& rig, const optics::RigCamera& camera) {
  const auto ball = optics::ball_projection(rig, camera);
  if (!ball) return tl::unexpected(ball.error());
  if (!camera.pose) return camera;
  const auto limb = ball->outline();
  if (!limb) return fail("camera " + camera.name + ": its lens does not show the whole ball");
  optics::RigCamera turnable = camera;
  turnable.registration = registration_of(camera.pose->rotation);
  turnable.outline = *limb;
  turnable.pose.reset();
  return turnable;
}

Result<optics::Pose> pose_of(const SoughtCamera& sought, const Registration& found) {
  if (!sought.camera.intrinsics) return fail("a pose needs intrinsics");
  const auto ball = turned(sought, found.rotation, found.outline);
  if (!ball) return tl::unexpected(ball.error());
  const Mat3& r = found.rotation;
  const optics::Ball& sphere = ball->ball();
  return optics::Pose{{-r.column0(), -r.column2(), -r.column1()},
                      sphere.centre + ball->facing() * (ball->distance() * sphere.radius)};
}

Result<BallProjection> turned(const SoughtCamera& sought, const Mat3& rotation,
                              const Outline& outline) {
  optics::RigCamera camera = sought.camera;
  camera.registration = rotation;
  camera.outline = outline;
  return optics::ball_projection(sought.rig, camera);
}

Result<BallProjection> in_own_frame(const SoughtCamera& sought) {
  optics::RigCamera camera = sought.camera;
  camera.registration = Mat3{};
  camera.window.reset();
  return optics::ball_projection(sought.rig, camera);
}

double overlap(const BallProjection& a, int a_width, int a_height, const BallProjection& b,
               int b_width, int b_height) {
  constexpr int kDirections = 2000;
  const auto shows = [](const BallProjection& ball, const Vec3& direction, int width, int height) {
    const auto pixel = ball.pixel(direction);
    return pixel && pixel->u >= 0 && pixel->v >= 0 && pixel->u <= width - 1 &&
           pixel->v <= height - 1;
  };
  int both = 0;
  for (int n = 0; n < kDirections; ++n) {
    const Vec3 direction = spiral(n, kDirections);
    both += shows(a, direction, a_width, a_height) && shows(b, direction, b_width, b_height);
  }
  return static_cast<double>(both) / kDirections;
}

Result<Registration> trusted(const Registration& r, int least_inliers) {
  if (r.inliers < least_inliers) {
    return fail("the cameras share only " + std::to_string(r.inliers) + " features that agree, " +
                std::to_string(least_inliers) +
                " are needed: state the room's geometry, light the room evenly, or put something "
                "with patterns where both see it");
  }
  if (r.overlap < kLeastOverlap) {
    return fail("both cameras see only " + rounded(100 * r.overlap) +
                " % of all directions: check the outlines, and that the pictures show the ball");
  }
  const auto sigma = sigmas(r);
  // Comparing the largest would miss NaN.
  if (!std::ranges::all_of(sigma, [](double one) { return one <= kWidestSigma; })) {
    const double widest = std::ranges::max(sigma);
    return fail("the rotation is uncertain by " + rounded(widest) +
                " degrees: what both see is too little or lies in one place; put something with "
                "patterns on another side of the ball");
  }
  return r;
}

}  // namespace orbwatch::align
