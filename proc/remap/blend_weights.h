#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/coordinate_grid.h"

namespace orbwatch::remap {

/// One source of a view, as its weights need it.
struct BlendSource {
  const CoordinateGrid& grid;
  const optics::BallProjection& ball;
  double weight = 1;  ///< the user's, above 0
  /// Pixels per degree beyond which more do not count, so that the weight alone decides wherever
  /// the source sees well; nothing: resolution decides everywhere.
  std::optional<double> enough;
};

/// How much each of up to kMaxSources sources counts in each pixel of a view: one plane per source,
/// in the view's size without padding, for merge().
///
/// A source has weight (pixels per degree there)^4, or weight min(1, pixels per degree / enough)^4,
/// and fades out towards the border of its picture where that cuts the ball; towards the limb its
/// resolution does so by itself. So the sharper camera dominates, or the user's shares hold, and no
/// seam shows where one of them begins or ends. Per pixel these are scaled to add up to 255 and
/// rounded: 0 where a source sees nothing, at least 1 where it sees, so that nothing is undefined
/// where any source sees, also when only the weaker one delivers.
///
/// Resolution is taken at the corners of the view's tiles. Allocates; not for the frame path.
std::vector<std::vector<std::uint8_t>> blend_weights(const optics::ViewProjection& view,
                                                     std::span<const BlendSource> sources);

}  // namespace orbwatch::remap
