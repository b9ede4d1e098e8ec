// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>

#include "proc/image/picture.h"

namespace orbwatch::tests {

/// A Bgr, Y16 or Grey picture that shares OpenCV's pixels.
inline Picture picture_of_mat(const cv::Mat& pixels) {
  const PixelFormat format = pixels.channels() == 3     ? PixelFormat::Bgr
                             : pixels.depth() == CV_16U ? PixelFormat::Y16
                                                        : PixelFormat::Grey;
  return Picture::contiguous(format, pixels.cols, pixels.rows,
                             reinterpret_cast<const std::byte*>(pixels.data),
                             static_cast<std::ptrdiff_t>(pixels.step));
}

}  // namespace orbwatch::tests
