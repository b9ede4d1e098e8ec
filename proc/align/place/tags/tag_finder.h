// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "proc/align/work_progress.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// A printed AprilTag of the family 36h11 in the ball's picture. Corners of its black border as
/// printed: top left, top right, bottom right, bottom left.
struct FoundTag {
  int id = 0;
  std::array<optics::Vec2, 4> corners;  ///< pixels of the ball's picture
};

/// Finds the tags in a ball's picture, sorted by id, each once, in un-mirrored views of the
/// camera's own surroundings; neither its pose nor distances need be known. `lens`: none if the
/// camera is not calibrated. Takes seconds. Reentrant. Error: the outline is not a ball's, or the
/// picture's size is not the lens's; cancelled by `progress`.
Result<std::vector<FoundTag>> find_tags(const Picture& picture, const optics::Outline& outline,
                                        const std::optional<optics::Lens>& lens,
                                        const WorkProgress& progress = {});

}  // namespace orbwatch::align
