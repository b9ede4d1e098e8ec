// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/rig.h"

#include <cmath>
#include <string>

namespace orbwatch::optics {
namespace {

auto about(const std::string& what) {
  return [what](const Error& error) { return Error{what + ": " + error.message}; };
}

/// Checks the members that do not depend on where the camera is.
Result<> check_optics(const RigCamera& camera) {
  if (camera.window) {
    if (!camera.intrinsics) return fail("a window needs intrinsics");
    if (auto checked = check_window(*camera.window); !checked) return checked;
  }
  if (camera.intrinsics && (camera.alpha || camera.distance)) {
    return fail("alpha and distance follow from the intrinsics; leave them out");
  }
  if (camera.intrinsics &&
      (camera.intrinsics->width != camera.width || camera.intrinsics->height != camera.height)) {
    return fail("the intrinsics are for " + std::to_string(camera.intrinsics->width) + "x" +
                std::to_string(camera.intrinsics->height) + " pixels, the camera has " +
                std::to_string(camera.width) + "x" + std::to_string(camera.height));
  }
  return {};
}

/// Checks for required and excluded members before anything is computed.
Result<> check_parts(const RigCamera& camera) {
  if (camera.pose.has_value() == camera.outline.has_value()) {
    return fail("give either a pose or the ball's outline");
  }
  if (camera.pose && !camera.intrinsics) return fail("a pose needs intrinsics");
  if (auto checked = check_optics(camera); !checked) return checked;
  if (camera.outline) return check_outline(*camera.outline, camera.width, camera.height);
  return {};
}

/// Converts a window from the machine frame and mm to the camera's frame and ball radii.
Window seen_by(const Mat3& camera, const Ball& ball, const Window& window) {
  return {camera * window.normal, window.thickness / ball.radius, window.index};
}

Result<Pose> pose(const RigCamera& camera, const Lens& lens, const Ball& ball) {
  if (camera.pose) return *camera.pose;
  const auto registration = checked_rotation(camera.registration);
  if (!registration) return tl::unexpected(registration.error());
  const Mat3 rotation{-registration->column0(), -registration->column2(), -registration->column1()};
  const Window window = camera.window ? seen_by(rotation, ball, *camera.window) : Window{};
  return sight_from_outline(*camera.outline, lens, window).map([&](const BallSight& sight) {
    const Vec3 towards_ball = transposed(rotation) * sight.axis;
    return Pose{rotation, ball.centre - towards_ball * (sight.distance * ball.radius)};
  });
}

Result<BallProjection> project(const Rig& rig, const RigCamera& camera, const SceneProxy& proxy) {
  if (auto checked = check_parts(camera); !checked) return tl::unexpected(checked.error());
  if (!camera.intrinsics) {
    return BallModel::make(camera.model, camera.alpha, camera.distance)
        .and_then([&](const BallModel& model) {
          return BallProjection::make(model, *camera.outline, camera.registration, rig.ball, proxy);
        });
  }
  return Lens::make(*camera.intrinsics).and_then([&](const Lens& lens) {
    return pose(camera, lens, rig.ball).and_then([&](const Pose& place) {
      return BallProjection::make(camera.model, {lens, place, camera.window}, rig.ball, proxy);
    });
  });
}

}  // namespace

Result<BallProjection> ball_projection(const Rig& rig, const RigCamera& camera) {
  if (!(rig.ball.radius > 0) || !std::isfinite(rig.ball.radius)) {
    return fail("ball: the radius must be above 0 mm");
  }
  const auto proxy = SceneProxy::make(rig.scene, rig.ball).map_error(about("scene"));
  if (!proxy) return tl::unexpected(proxy.error());
  return project(rig, camera, *proxy).map_error(about("camera " + camera.name));
}

bool is_unplaced(const RigCamera& camera) { return !camera.pose && !camera.outline; }

Result<> check_unplaced(const RigCamera& camera) {
  return check_optics(camera)
      .and_then([&]() -> Result<> {
        if (!camera.intrinsics) return {};
        return Lens::make(*camera.intrinsics).map([](const Lens&) {});
      })
      .map_error(about("camera " + camera.name));
}

}  // namespace orbwatch::optics
