#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/drift/picture_motion.h"
#include "proc/optics/ball_projection.h"

namespace orbwatch::align {

/// What a motion of the ball's picture does to directions, as long as the stored alignment is used:
/// rms angle, over all directions up to kSeen from the one towards the camera, between the
/// reflected ray that the stored alignment assigns to a pixel and the one of the place where that
/// pixel's part of the ball stood. Reentrant, immutable.
class ViewError {
 public:
  /// Degrees from the direction towards the camera. Beyond, everything is compressed into the limb,
  /// and the error has no limit.
  static constexpr double kSeen = 150;

  ViewError(const optics::BallProjection& projection, const optics::Outline& outline);

  /// Degrees, for motions of any size; pixels that show the ball only before or only after the
  /// motion have no error and do not count. Takes some tenths of a millisecond.
  double exact(const PictureMotion& motion) const;

  /// Degrees, in proportion to the motion: right to some per cent for 1 % of the radius.
  double small(const PictureMotion& motion) const;

 private:
  struct Seen {
    optics::Vec2 pixel;
    optics::Vec3 direction;
  };

  optics::BallProjection projection_;
  optics::Outline outline_;
  std::vector<Seen> seen_;
  cv::Matx44d square_;  ///< of (u, v, growth, roll): squared degrees
};

}  // namespace orbwatch::align
