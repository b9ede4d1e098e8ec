// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/lanes.h"
#include "proc/optics/lens.h"
#include "proc/optics/rotation.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

/// FFmpeg v360 calls them flat, equirect, cylindrical, sg, fisheye. Ball is a camera's own picture,
/// cropped to the ball.
enum class ViewKind { Perspective, Equirectangular, Cylindrical, Stereographic, Fisheye, Ball };

/// A virtual camera at the ball's centre. Angles in degrees, in FFmpeg v360's terms.
struct ViewSpec {
  ViewKind kind = ViewKind::Perspective;
  YawPitchRoll orientation;  ///< 0 for Ball, whose picture is not turned
  /// Field of view from edge to edge through the middle. Default: 90 perspective, 360
  /// equirectangular and cylindrical, 180 stereographic and fisheye. Ball has none.
  std::optional<double> h_fov;
  std::optional<double> v_fov;  ///< default: 180 equirectangular, from square pixels for the others
  int width = 0;
  int height = 0;
};

/// Error: sizes outside 1..kMaxSide, angles that are not finite, fields of view that the kind
/// cannot have, any angle for Ball.
Result<> check_view(const ViewSpec& spec);

/// The horizontal field of view, stated or the kind's default, degrees; 0: Ball has none.
/// Reentrant.
double h_fov_of(const ViewSpec& spec);

/// Converts a view's pixels to directions in the reference frame and back. Reentrant, immutable.
///
/// Straight ahead is the picture's middle, ((W-1)/2, (H-1)/2). With x right and y up from there:
/// Perspective: x, y = f tan. Equirectangular: longitude and latitude are linear in x, y.
/// Cylindrical: longitude is linear in x, y = f tan(latitude). Stereographic, at the angle theta
/// from straight ahead: r = 2 f tan(theta/2). Fisheye (equidistant): r = f theta.
class ViewProjection {
 public:
  /// Error: that of check_view(). Ball views need a camera: see below.
  static Result<ViewProjection> make(const ViewSpec& spec);

  /// A view of any kind; a Ball view shows that camera's picture, cropped to the limb's bounding
  /// box and a margin, with square pixels: the camera's own, if the sizes differ by no more than 1
  /// %. Error: also a limb that the lens does not show.
  static Result<ViewProjection> make(const ViewSpec& spec, const BallProjection& ball);

  /// A Ball view that shows a camera's whole picture, which has this size, pixel by pixel. Error:
  /// that of check_view().
  static Result<ViewProjection> whole_picture(const BallProjection& ball, int width, int height);

  /// Unit vector of a pixel (OpenCV convention), also slightly outside the picture. nullopt beyond
  /// the projection's end: beyond 180 degrees from a fisheye's axis, outside of the ball's limb.
  std::optional<Vec3> direction(double u, double v) const;

  /// The same for kLanes pixels; NaN for nullopt.
  void directions(const Vec2Lanes& pixels, Vec3Lanes& out) const;

  /// The pixel that shows a unit vector; it may lie outside of the picture. nullopt for directions
  /// without exactly one pixel: behind a perspective camera, the poles of a cylinder, straight
  /// behind the others, the blind cone of a ball's picture.
  std::optional<Vec2> pixel(const Vec3& direction) const;

  /// The solid angle that the pixel at (u, v) covers, in steradian; 0 where direction() returns
  /// nullopt.
  double solid_angle(double u, double v) const;

  /// ROS' camera_info of a perspective view; nullopt for other kinds.
  std::optional<Intrinsics> intrinsics() const;

  /// The pixel of a Ball view that shows a pixel of its camera.
  Vec2 of_camera_pixel(const Vec2& pixel) const;

  /// The specification that it was made from.
  const ViewSpec& spec() const { return spec_; }
  /// The camera of a Ball view; nullopt for other kinds.
  const std::optional<BallProjection>& ball() const { return ball_; }
  ViewKind kind() const { return spec_.kind; }
  int width() const { return spec_.width; }
  int height() const { return spec_.height; }

 private:
  explicit ViewProjection(const ViewSpec& spec);

  Result<> crop(const BallProjection& ball);
  Vec2 camera_pixel(double u, double v) const;
  double ball_solid_angle(double u, double v) const;

  ViewSpec spec_;
  Mat3 orientation_;
  /// Step per pixel: radians where the projection is linear in an angle, else that of the tangent
  /// (for Stereographic of half the angle), for Ball camera pixels.
  double step_u_ = 0;
  double step_v_ = 0;
  std::optional<BallProjection> ball_;  ///< Ball only
  Vec2 crop_centre_;                    ///< Ball only, camera pixels
};

}  // namespace orbwatch::optics
