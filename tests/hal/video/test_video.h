// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/videoio.hpp>

namespace orbwatch::tests {

inline constexpr int kVideoWidth = 64;
inline constexpr int kVideoHeight = 48;
inline constexpr double kVideoRate = 25.0;

/// Colours of picture k of a test video: red 20 k + 10 and blue 200, within the loss of MJPEG.
inline int red_of(std::uint64_t picture) { return static_cast<int>(picture) * 20 + 10; }

inline void write_video(const std::filesystem::path& path, int count) {
  cv::VideoWriter writer(path.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), kVideoRate,
                         {kVideoWidth, kVideoHeight});
  ASSERT_TRUE(writer.isOpened());
  for (int k = 0; k < count; ++k) {
    writer.write(cv::Mat(kVideoHeight, kVideoWidth, CV_8UC3,
                         cv::Scalar(200, 100, red_of(static_cast<std::uint64_t>(k)))));
  }
}

}  // namespace orbwatch::tests
