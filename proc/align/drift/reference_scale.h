// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "proc/align/drift/patch.h"
#include "proc/align/drift/picture_motion.h"

namespace orbwatch::align {

/// A patch and its place in the reference.
struct PlacedPatch {
  Patch patch;
  cv::Point corner;  ///< px
  optics::Vec2 arm;  ///< px, from the outline's centre to the patch's
};

/// Patches that move together.
using PatchGroup = std::vector<PlacedPatch>;

/// Content of a reference picture at one scale: the ball with its limb, and its surroundings.
struct ReferenceScale {
  optics::Outline outline;  ///< px, at this scale
  PatchGroup ball;          ///< all around, more of them towards the limb
  PatchGroup surroundings;
};

/// Chooses the patches with the most texture, spread over the ball and its surroundings. `picture`:
/// smoothed, 32F; brightness from `saturated` on is not used. `sectors`: the ball has four patches
/// in each. Reentrant.
ReferenceScale reference_scale(const cv::Mat& picture, const optics::Outline& outline,
                               float saturated, int sectors);

/// The patches of a group found in a picture.
struct Sighting {
  struct Found {
    optics::Vec2 arm;
    PatchShift shift;  ///< from the reference's place
  };
  std::vector<Found> found;
  int expected = 0;   ///< patches whose surroundings are in the picture
  int saturated = 0;  ///< number of saturated ones
  int flat = 0;       ///< number of those with hardly any contrast
};

/// Reads a window; false when it is not within the picture.
using ReadWindow = std::function<bool(cv::Point corner, PatchWindow& window)>;

/// Finds a group's patches again near their places by `guess`. `sighting` is overwritten and keeps
/// its memory.
void find_patches(const PatchGroup& group, const PictureMotion& guess, const ReadWindow& read,
                  Sighting& sighting);

}  // namespace orbwatch::align
