// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "tests/bench/frame.h"

namespace orbwatch::bench {

/// A plane's samples as a cv::Mat header. OpenCV has no matrix of constant samples; sources are
/// only read.
inline cv::Mat header_of(const Plane& plane) {
  const int depth = plane.sample_bytes == 1 ? CV_8U : CV_16U;
  auto* data = const_cast<std::byte*>(plane.bytes.data());
  return {plane.height, plane.width, CV_MAKETYPE(depth, plane.samples), data,
          static_cast<std::size_t>(plane.stride)};
}

}  // namespace orbwatch::bench
