// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/luminance.h"

#include <gtest/gtest.h>

#include <vector>

namespace orbwatch::align {
namespace {

/// A picture of any format whose first sample of each pixel is its column.
struct Columns {
  explicit Columns(PixelFormat format) {
    const auto stride = static_cast<std::size_t>(row_bytes(format, 8)) + 6;
    bytes.resize(picture_bytes(format, stride, 4));
    picture = Picture::contiguous(format, 8, 4, bytes.data(), static_cast<std::ptrdiff_t>(stride));
    const int step = info(format).channels() * info(format).bytes_per_sample();
    for (int v = 0; v < 4; ++v) {
      for (int u = 0; u < 8; ++u) {
        for (int i = 0; i < step; i += info(format).bytes_per_sample()) {
          bytes[static_cast<std::size_t>(v) * stride + static_cast<std::size_t>(u * step + i)] =
              static_cast<std::byte>(u);
        }
      }
    }
  }
  std::vector<std::byte> bytes;
  Picture picture;
};

TEST(Luminance, OfEveryFormat) {
  for (const PixelFormatInfo& format : kPixelFormats) {
    const Columns columns(format.format);
    const cv::Mat luminance = luminance_of(columns.picture);
    EXPECT_EQ(luminance.size(), cv::Size(8, 4)) << format.name;
    EXPECT_EQ(luminance.type(), format.bits > 8 ? CV_16UC1 : CV_8UC1) << format.name;
    for (int u = 0; u < 8; ++u) {
      const int sample =
          format.bits > 8 ? luminance.at<std::uint16_t>(3, u) : luminance.at<std::uint8_t>(3, u);
      EXPECT_EQ(sample, u) << format.name;
    }
    const cv::Mat part = luminance_of(columns.picture, {3, 1, 4, 2});
    EXPECT_EQ(part.size(), cv::Size(4, 2)) << format.name;
    EXPECT_EQ(cv::norm(part, luminance({3, 1, 4, 2}), cv::NORM_INF), 0) << format.name;
  }
}

}  // namespace
}  // namespace orbwatch::align
