#pragma once

#include <optional>

#include "proc/image/result.h"
#include "proc/optics/ball_model.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

/// The ball's limb in a picture: an ellipse in pixels (OpenCV convention). `angle`, degrees: of the
/// rx axis, from u towards v. A circle has rx = ry.
struct Outline {
  Vec2 centre;
  double rx = 0;
  double ry = 0;
  double angle = 0;
};

/// Refuses an outline whose centre lies outside of a picture of this size. A ball that the picture
/// cuts is allowed: what it shows beyond the border is undefined.
Result<> check_outline(const Outline& outline, int picture_width, int picture_height);

/// Where one camera shows a direction: ball model, the limb in that camera's picture and the
/// camera's registration. Reentrant, immutable.
///
/// Frames: directions are unit vectors in the reference (machine) frame, X right, Y forward, Z up.
/// Without a registration the camera stands on +Y of the ball and looks along -Y, image right = -X,
/// image up = +Z. v_reference = registration v_camera.
class BallProjection {
 public:
  /// Error: an outline that is no ellipse with finite numbers and positive axes, or a registration
  /// that is no rotation.
  static Result<BallProjection> make(const BallModel& model, const Outline& outline,
                                     const Mat3& registration);

  /// The pixel that shows `direction`; nothing in the blind cone. It may lie outside the picture
  /// when the picture cuts the ball.
  std::optional<Vec2> pixel(const Vec3& direction) const;

  /// The direction that `pixel` shows; nothing outside the limb.
  std::optional<Vec3> direction(const Vec2& pixel) const;

 private:
  BallProjection(const BallModel& model, const Outline& outline, const Mat3& registration);

  BallModel model_;
  Outline outline_;
  Mat3 camera_to_reference_;
  Mat3 reference_to_camera_;
  // Symmetric map from the unit disc (right, down) to pixels around the centre.
  double stretch_uu_;
  double stretch_uv_;
  double stretch_vv_;
};

}  // namespace orbwatch::optics
