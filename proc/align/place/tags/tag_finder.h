#pragma once

#include <array>
#include <optional>
#include <vector>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// A printed AprilTag of the family 36h11 that the ball shows. Corners as the tag is printed, of
/// its black border: top left, top right, bottom right, bottom left.
struct FoundTag {
  int id = 0;
  std::array<optics::Vec2, 4> corners;  ///< pixels of the ball's picture
};

/// The tags that a ball shows, by id, each once. They are looked for in un-mirrored views of the
/// camera's own surroundings; neither its pose nor distances need be known. `lens`: none if the
/// camera is not calibrated. Takes seconds. Reentrant. Error: no ball's outline, or a picture of
/// another size than the lens.
Result<std::vector<FoundTag>> find_tags(const Picture& picture, const optics::Outline& outline,
                                        const std::optional<optics::Lens>& lens);

}  // namespace orbwatch::align
