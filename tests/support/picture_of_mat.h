// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

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

/// Each of a sequence, in its order.
inline std::vector<Picture> pictures_of_mats(const std::vector<cv::Mat>& pixels) {
  std::vector<Picture> pictures;
  for (const cv::Mat& one : pixels) pictures.push_back(picture_of_mat(one));
  return pictures;
}

}  // namespace orbwatch::tests
