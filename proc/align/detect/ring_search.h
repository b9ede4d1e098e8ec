#pragma once

#include <opencv2/core.hpp>

#include "proc/optics/vec.h"

namespace orbwatch::align {

/// A circle that may be a ball's limb, pixels.
struct Ring {
  optics::Vec2 centre;
  double radius = 0;
  double likeness = 0;  ///< LimbColumns::above_random(), the mean of all parts
};

/// The circle most like a limb of those around `place` with a radius between RingStrip::kNearest
/// and kFarthest; a quarter of it off at most. `luminance`: one channel, 8 or 16 bit. Reentrant.
Ring likeliest_ring(const cv::Mat& luminance, optics::Vec2 place);

}  // namespace orbwatch::align
