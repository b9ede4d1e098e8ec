// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::align {

/// A sixth of the ball's reflection and its surroundings, seen from the ball's centre:
/// stereographic, which keeps small shapes, and un-mirrored.
struct SphereFace {
  optics::ViewProjection view;
  cv::Mat pixels;  ///< the source's type
  cv::Mat shown;   ///< 8 bit, 255 where the ball shows it well enough
};

/// Index among sphere_faces() of the face that a direction belongs to. Reentrant.
std::size_t face_of(const optics::Vec3& direction);

/// Renders everything around a ball, in the ball projection's reference frame, at
/// `pixels_per_degree` in the middle of each face. `luminance`: the camera's picture, one channel.
/// Places within some degrees of the limb, outside of the picture or behind the ball are not shown.
/// `closeness`: ball radius / distance of everything, instead of the projection's scene. Reentrant.
/// Error: a resolution that is too large for a picture.
Result<std::vector<SphereFace>> sphere_faces(const cv::Mat& luminance,
                                             const optics::BallProjection& ball,
                                             double pixels_per_degree,
                                             const std::optional<double>& closeness = {});

/// The pixel that shows a direction in such faces. Reentrant.
inline std::optional<optics::Vec2> pixel_of(const optics::BallProjection& ball,
                                            const optics::Vec3& direction,
                                            const std::optional<double>& closeness) {
  return closeness ? ball.pixel(direction, *closeness) : ball.pixel(direction);
}

/// A camera's pixels per degree where its ball has the highest resolution. Reentrant.
double best_resolution(const optics::BallProjection& ball);

/// A picture's luminance stretched to 8 bit, from its darkest to its brightest percent. Reentrant.
cv::Mat stretched(const cv::Mat& luminance);

}  // namespace orbwatch::align
