#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/optics/vec.h"

namespace orbwatch::align {

/// A circle that may be a ball's limb, pixels.
struct Ring {
  optics::Vec2 centre;
  double radius = 0;
  double likeness = 0;  ///< LimbColumns::above_random(), the mean of all parts
};

/// The circles most like a limb of those around `place` with a radius between RingStrip::kNearest
/// and kFarthest; a quarter of it off at most. The best `most` that differ by a tenth of it, the
/// best first. `luminance`: one channel, 8 or 16 bit. Reentrant.
std::vector<Ring> likeliest_rings(const cv::Mat& luminance, optics::Vec2 place, std::size_t most);

}  // namespace orbwatch::align
