// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "proc/align/register/sphere_view.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// One feature in the pictures of two cameras.
struct Match {
  optics::Vec2 reference;  ///< px
  optics::Vec2 camera;     ///< px
};

/// Distinctive points of one camera's picture.
struct Features {
  std::vector<optics::Vec2> pixels;      ///< in the camera's picture
  std::vector<optics::Vec3> directions;  ///< in the faces' frame
  cv::Mat descriptors;                   ///< SIFT descriptors, one row each
};

/// SIFT features (Lowe 2004) of all faces, without duplicates. `ball` and `closeness`: those that
/// the faces were made with. Reentrant.
Features find_features(const std::vector<SphereFace>& faces, const optics::BallProjection& ball,
                       const std::optional<double>& closeness = {});

/// Pairs of features that are each other's nearest, and much nearer than the second. Reentrant.
std::vector<Match> match_features(const Features& reference, const Features& camera);

/// The same among features whose directions differ by `angle` radians at most. Reentrant.
std::vector<Match> match_features(const Features& reference, const Features& camera, double angle);

}  // namespace orbwatch::align
