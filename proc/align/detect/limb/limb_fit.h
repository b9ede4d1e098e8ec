// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "proc/optics/outline.h"

namespace orbwatch::align {

struct LimbFit {
  optics::Outline outline;
  double likeness = 0;  ///< LimbLikelihood::above_random()
};

/// Fits the most likely limb whose distance from `outline` is about `reach` pixels at most.
/// `luminance`: one channel, 8 or 16 bit; `outline` in its pixels, returned unchanged and unlike
/// any limb when an axis is hardly longer than `reach`. Reentrant.
LimbFit fit_limb(const cv::Mat& luminance, const optics::Outline& outline, double reach);

}  // namespace orbwatch::align
