// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "proc/image/picture.h"

namespace orbwatch::align {

/// A picture's brightness: one channel, 8 or 16 bit; shares the picture's memory if brightness is
/// one of its planes. Reentrant.
cv::Mat luminance_of(const Picture& picture);

}  // namespace orbwatch::align
