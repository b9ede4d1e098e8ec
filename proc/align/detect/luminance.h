#pragma once

#include <opencv2/core.hpp>

#include "proc/image/picture.h"

namespace orbwatch::align {

/// A picture's brightness: one channel, 8 or 16 bit; shared with the picture where that has it as a
/// plane. Reentrant.
cv::Mat luminance_of(const Picture& picture);

}  // namespace orbwatch::align
