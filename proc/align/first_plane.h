// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>

#include "proc/image/picture.h"

namespace orbwatch::align {

/// A picture's first plane as a cv::Mat that shares the picture's memory and must not be written
/// to: OpenCV has no view of constant data. Reentrant.
inline cv::Mat first_plane(const Picture& picture) {
  const PixelFormatInfo& facts = info(picture.format);
  const int depth = facts.bytes_per_sample() == 2 ? CV_16U : CV_8U;
  return {picture.height, picture.width, CV_MAKETYPE(depth, facts.channels()),
          const_cast<std::byte*>(picture.planes[0].data),
          static_cast<std::size_t>(picture.planes[0].stride)};
}

}  // namespace orbwatch::align
