// SPDX-License-Identifier: Apache-2.0
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

/// The circles around `place` most like a limb, with a radius between RingStrip::kNearest and
/// kFarthest and a centre off by at most a quarter of it. At most `most`, which differ by a tenth
/// of the radius, the best first. `luminance`: one channel, 8 or 16 bit. Reentrant.
std::vector<Ring> likeliest_rings(const cv::Mat& luminance, optics::Vec2 place, std::size_t most);

}  // namespace orbwatch::align
