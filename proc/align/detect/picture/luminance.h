// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "proc/image/picture.h"

namespace orbwatch::align {

/// A picture's brightness: one channel, 8 or 16 bit; shares the picture's memory if brightness is
/// one of its planes. Reentrant.
cv::Mat luminance_of(const Picture& picture);

/// The same for a part within the picture. Reentrant.
cv::Mat luminance_of(const Picture& picture, const cv::Rect& part);

}  // namespace orbwatch::align
