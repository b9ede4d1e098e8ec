// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/vec.h"
#include "proc/optics/window.h"

namespace orbwatch::optics {

/// The ball's limb in a picture: an ellipse in pixels (OpenCV convention). `angle`, degrees: that
/// of the rx axis, from u towards v. A circle has rx = ry.
struct Outline {
  Vec2 centre;
  double rx = 0;
  double ry = 0;
  double angle = 0;
};

/// The mean of both half axes, px.
constexpr double mean_radius(const Outline& outline) { return (outline.rx + outline.ry) / 2; }

/// Distance of a pixel from the centre, relative to that of the limb in the same direction: 1 on
/// the limb. Reentrant.
double relative_distance(const Outline& outline, const Vec2& pixel);

/// Error: numbers that are not finite, axes that are not above 0.
Result<> check_ellipse(const Outline& outline);

/// Error: an outline whose centre lies outside of a picture of this size. The picture may cut the
/// ball; its part beyond the border is undefined.
Result<> check_outline(const Outline& outline, int picture_width, int picture_height);

/// The position of the ball relative to a camera.
struct BallSight {
  Vec3 axis;            ///< unit vector towards the ball's centre, camera frame
  double distance = 0;  ///< from camera to the ball's centre, ball radii, > 1
};

/// The ball's position from its limb and a known lens, on or off the optical axis: the limb's rays
/// lie on a circular cone, a . w = cos(psi_max), which a linear fit over the ellipse's points
/// solves; 1/distance = sin(psi_max). `window`: a glass before the lens, normal in the camera
/// frame, thickness in ball radii; thickness 0 means none. Error: not an ellipse, a limb that the
/// lens cannot show, or one that is not a ball's (rays off the cone by more than 5 % of its
/// aperture).
Result<BallSight> sight_from_outline(const Outline& outline, const Lens& lens,
                                     const Window& window = {});

/// The limb of a ball in that position: an ellipse, exact without distortion and window, else the
/// best fit. `window`: see sight_from_outline(). Error: the lens does not show the whole limb.
Result<Outline> outline_from_sight(const BallSight& sight, const Lens& lens,
                                   const Window& window = {});

}  // namespace orbwatch::optics
