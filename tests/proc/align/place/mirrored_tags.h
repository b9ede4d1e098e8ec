// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "tests/proc/align/place/mirrored_rig.h"

/// Pictures of a ball that reflects printed AprilTags, traced by plain vectors.
namespace orbwatch::tests {

struct PrintedTag {
  int id = 0;
  std::array<optics::Vec3, 4> corners;  ///< corners of its black border, as printed; mm
};

/// A square tag in that direction, its printed side towards the ball except for a tilt, turned in
/// its plane.
PrintedTag tag_around(const MirroredRig& rig, const optics::Vec3& direction, double distance,
                      double side, double tilt, double turn, int id);

/// One camera that approximately faces a ball of 50 mm, and four tags of 120 mm in directions well
/// apart, 6 to 10 radii away.
struct TagScene {
  MirroredRig rig;
  std::vector<PrintedTag> tags;
};
/// `least`, `most`: radius of the ball's picture, px. `side`: the picture's, px.
TagScene random_tag_scene(std::mt19937_64& random, double least, double most, int side);

/// The camera's picture of ball and tags, 8 bit: nine rays per pixel, a room of soft light, noise
/// of that sigma. Tags have a white margin of one cell.
cv::Mat picture_of_tags(const MirroredRig& rig, const RigCamera& camera,
                        const std::vector<PrintedTag>& tags, double noise, std::mt19937_64& random);

}  // namespace orbwatch::tests
