#pragma once

#include <opencv2/core.hpp>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// How well an ellipse's surroundings fit a ball's limb.
struct LimbScore {
  /// By how much slopes agree better with the normal inside than outside, -0.5 to 1; random ones 0.
  double drop = 0;
  /// The edge on the limb as a share of the strongest one nearby, the mean of all rays, 0 to 1.
  double contour = 0;
};

/// Of an outline with axes above 10 pixels in `luminance`: one channel, 8 or 16 bit. Reentrant.
LimbScore limb_score(const cv::Mat& luminance, const optics::Outline& outline);

/// LimbScore::drop, but only close to the limb: a limb that is off by little has less of it there.
/// -0.5 to 1. Reentrant.
double near_drop(const cv::Mat& luminance, const optics::Outline& outline);

}  // namespace orbwatch::align
