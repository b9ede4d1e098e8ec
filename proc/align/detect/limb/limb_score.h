// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "proc/optics/outline.h"

namespace orbwatch::align {

// For outlines with axes above 10 pixels in `luminance`: one channel, 8 or 16 bit. Reentrant.

/// Excess of the slopes' agreement with the normal inside of the limb over that outside, close to
/// it: -0.5 to 1; random ones 0. A limb that is slightly off has less of it.
double near_drop(const cv::Mat& luminance, const optics::Outline& outline);

/// The edge on the limb as a share of the strongest one nearby, the mean of all rays, 0 to 1.
double contour(const cv::Mat& luminance, const optics::Outline& outline);

}  // namespace orbwatch::align
