#pragma once

#include <opencv2/core.hpp>

#include "proc/optics/outline.h"

namespace orbwatch::align {

// Of outlines with axes above 10 pixels in `luminance`: one channel, 8 or 16 bit. Reentrant.

/// By how much slopes agree better with the normal inside of the limb than outside, close to it:
/// -0.5 to 1; random ones 0. A limb that is off by little has less of it.
double near_drop(const cv::Mat& luminance, const optics::Outline& outline);

/// The edge on the limb as a share of the strongest one nearby, the mean of all rays, 0 to 1.
double contour(const cv::Mat& luminance, const optics::Outline& outline);

}  // namespace orbwatch::align
