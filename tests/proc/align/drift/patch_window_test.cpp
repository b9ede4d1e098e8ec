// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/patch_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace orbwatch::align {
namespace {

constexpr int kNoisyWidth = 150, kNoisyHeight = 140;

/// A picture of any format full of noise, with padded rows; its last sample ends its memory.
struct NoisyPicture {
  explicit NoisyPicture(PixelFormat format) {
    const auto stride = static_cast<std::size_t>(row_bytes(format, kNoisyWidth)) + 6;
    bytes.resize(picture_bytes(format, stride, kNoisyHeight));
    std::mt19937 random(static_cast<unsigned>(format));
    const std::size_t bits = static_cast<std::size_t>(info(format).bits);
    for (std::size_t n = 0; n < bytes.size(); n += 2) {
      // Little-endian samples within the format's range, or two of 8 bit.
      const auto value =
          static_cast<std::uint16_t>(bits > 8 ? random() % (1U << bits) : random() % (1U << 16));
      std::memcpy(bytes.data() + n, &value, std::min<std::size_t>(2, bytes.size() - n));
    }
    picture = Picture::contiguous(format, kNoisyWidth, kNoisyHeight, bytes.data(),
                                  static_cast<std::ptrdiff_t>(stride));
  }
  std::vector<std::byte> bytes;
  Picture picture;
};

TEST(WindowReader, ReadsTheSmoothedBrightnessOfEveryFormatAtEveryScale) {
  for (const PixelFormatInfo& format : kPixelFormats) {
    const NoisyPicture noisy(format.format);
    for (const int scale : {1, 2, 4}) {
      const cv::Mat smoothed = smoothed_luminance(noisy.picture, scale);
      // The last one with a pixel around it is the last corner.
      const cv::Point last(kNoisyWidth / scale - PatchWindow::kSide - 1,
                           kNoisyHeight / scale - PatchWindow::kSide - 1);
      WindowReader reader(scale);
      for (const cv::Point corner : {cv::Point(1, 1), cv::Point(4, 3), last}) {
        PatchWindow window;
        ASSERT_TRUE(reader.read(noisy.picture, corner, window)) << format.name << ' ' << scale;
        double worst = 0;
        for (int v = 0; v < PatchWindow::kSide; ++v) {
          for (int u = 0; u < PatchWindow::kSide; ++u) {
            const double difference =
                window.row(v)[u] - smoothed.at<float>(corner.y + v, corner.x + u);
            worst = std::max(worst, std::abs(difference));
          }
        }
        // OpenCV rounds brightness and means to whole counts, each by half a count at most.
        const bool is_rounded = scale > 1 || format.channels() > 2;
        EXPECT_LT(worst, is_rounded ? 1 : 0.01) << format.name << ' ' << scale;
      }
    }
  }
}

TEST(WindowReader, RefusesWindowsThatAreNotWithinThePicture) {
  const NoisyPicture noisy(PixelFormat::Grey);
  WindowReader reader(2);
  PatchWindow window;
  EXPECT_FALSE(reader.read(noisy.picture, {0, 1}, window));
  EXPECT_FALSE(reader.read(noisy.picture, {1, 0}, window));
  EXPECT_FALSE(reader.read(noisy.picture, {kNoisyWidth / 2 - PatchWindow::kSide, 1}, window));
  EXPECT_FALSE(reader.read(noisy.picture, {1, kNoisyHeight / 2 - PatchWindow::kSide}, window));
}

}  // namespace
}  // namespace orbwatch::align
