// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/drift/picture_motion.h"
#include "proc/optics/ball_projection.h"

namespace orbwatch::align {

/// Error of view directions that a motion of the ball's picture causes while the stored alignment
/// is used: rms angle, over all directions up to kSeen from the one towards the camera, between two
/// reflected rays: the one that the stored alignment assigns to a pixel, and that of the former
/// place of that pixel's part of the ball. Reentrant, immutable.
class ViewError {
 public:
  /// Degrees from the direction towards the camera. Beyond it everything is compressed into the
  /// limb, and the error has no limit.
  static constexpr double kSeen = 150;

  ViewError(const optics::BallProjection& projection, const optics::Outline& outline);

  /// Degrees, for motions of any size; pixels that show the ball only before or only after the
  /// motion have no error and do not count. Takes some tenths of a millisecond.
  double exact(const PictureMotion& motion) const;

  /// Degrees, linear in the motion: accurate to some per cent for 1 % of the radius.
  double small(const PictureMotion& motion) const;

 private:
  struct Seen {
    optics::Vec2 pixel;
    optics::Vec3 direction;
  };

  optics::BallProjection projection_;
  optics::Outline outline_;
  std::vector<Seen> seen_;
  cv::Matx44d square_;  ///< quadratic form of (u, v, growth, roll): squared degrees
};

}  // namespace orbwatch::align
