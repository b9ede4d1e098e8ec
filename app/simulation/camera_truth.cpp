#include "app/simulation/camera_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbwatch::app::simulation {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

void set_angles(CameraTruth& truth, const optics::Mat3& rotation) {
  // The columns are the turned X, Y and Z axis; at the poles yaw and roll are one, called yaw.
  constexpr double kPole = 1e-9;
  const Vec3 right = rotation.column0();
  const Vec3 forward = rotation.column1();
  const Vec3 up = rotation.column2();
  truth.pitch = std::asin(std::clamp(forward.z, -1.0, 1.0)) * kDegrees;
  if (std::hypot(forward.x, forward.y) < kPole) {
    truth.yaw = std::atan2(-right.y, right.x) * kDegrees;
    truth.roll = 0;
  } else {
    truth.yaw = std::atan2(forward.x, forward.y) * kDegrees;
    truth.roll = std::atan2(-right.z, up.z) * kDegrees;
  }
}

}  // namespace

CameraTruth truth_of(const Pinhole& camera, const Sphere& ball) {
  const double half_angle = std::asin(ball.radius / norm(ball.centre - camera.position));
  CameraTruth truth;
  truth.outline = {camera.cx(), camera.cy(), camera.focal_length * std::tan(half_angle)};
  truth.alpha = 360 - 2 * half_angle * kDegrees;
  const optics::Mat3& axes = camera.rotation;
  const optics::Mat3 rotation = optics::transposed({-axes.row0, -axes.row2, -axes.row1});
  truth.rotation = {rotation.row0.x, rotation.row0.y, rotation.row0.z,
                    rotation.row1.x, rotation.row1.y, rotation.row1.z,
                    rotation.row2.x, rotation.row2.y, rotation.row2.z};
  set_angles(truth, rotation);
  return truth;
}

}  // namespace orbwatch::app::simulation
