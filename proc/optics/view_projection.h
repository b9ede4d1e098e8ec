#pragma once

#include <optional>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/rotation.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

enum class ViewKind { Perspective, Equirectangular };

/// A virtual camera in the ball's centre. Angles in degrees, in FFmpeg v360's terms.
struct ViewSpec {
  ViewKind kind = ViewKind::Perspective;
  YawPitchRoll orientation;
  std::optional<double> h_fov;  ///< edge to edge; else 90 perspective, 360 equirectangular
  std::optional<double> v_fov;  ///< else from square pixels (perspective), 180 (equirectangular)
  int width = 0;
  int height = 0;
};

/// From a view's pixels to directions in the reference frame. Reentrant, immutable.
///
/// Perspective: f = (W/2) / tan(h_fov/2), principal point ((W-1)/2, (H-1)/2). Equirectangular:
/// longitude and latitude linear from the picture's corner, centre straight ahead.
class ViewProjection {
 public:
  /// Error: sizes outside 1..kMaxSide, angles that are not finite, a perspective h_fov or v_fov
  /// outside (0, 180), an equirectangular one outside (0, 360] and (0, 180].
  static Result<ViewProjection> make(const ViewSpec& spec);

  /// Unit vector of a pixel (OpenCV convention), also a little outside the picture.
  Vec3 direction(double u, double v) const;

  /// The solid angle that the pixel at (u, v) covers, in steradian.
  double solid_angle(double u, double v) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  ViewProjection(const ViewSpec& spec, double h_fov, double v_fov);

  ViewKind kind_;
  int width_;
  int height_;
  Mat3 orientation_;
  double step_u_;  ///< perspective: tangent per pixel; equirectangular: radians per pixel
  double step_v_;
};

}  // namespace orbwatch::optics
