#pragma once

#include <opencv2/core.hpp>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The most likely limb whose distance from `outline` is about `reach` pixels at most. `luminance`:
/// one channel, 8 or 16 bit. Reentrant.
optics::Outline fit_limb(const cv::Mat& luminance, const optics::Outline& outline, double reach);

}  // namespace orbwatch::align
