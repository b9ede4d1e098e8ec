// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/picture_conversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace orbwatch::app {
namespace {

constexpr int kWidth = 34;
constexpr int kHeight = 18;
constexpr int kPadding = 6;

/// Picture of random samples with padded rows; those of Y'CbCr are in the limited range, beyond
/// which OpenCV clips earlier.
struct Noise {
  explicit Noise(PixelFormat format, std::uint32_t seed = 1)
      : stride(row_bytes(format, kWidth) + kPadding),
        bytes(picture_bytes(format, static_cast<std::size_t>(stride), kHeight)) {
    std::mt19937 random(seed);
    const bool limited = info(format).colour == ColourModel::Yuv;
    std::ranges::generate(
        bytes, [&] { return static_cast<std::byte>(limited ? 16 + random() % 220 : random()); });
    picture = Picture::contiguous(format, kWidth, kHeight, bytes.data(), stride);
    const int bits = info(format).bits;
    for (std::size_t i = 0; bits > 8 && bits < 16 && i < bytes.size() / 2; ++i) {
      reinterpret_cast<std::uint16_t*>(bytes.data())[i] &= (1U << bits) - 1;
    }
  }

  int stride;
  std::vector<std::byte> bytes;
  Picture picture;
};

cv::Mat converted(const Picture& picture, PixelFormat to) {
  cv::Mat out(kHeight, kWidth,
              CV_MAKETYPE(to == PixelFormat::Y16 ? CV_16U : CV_8U, info(to).channels()));
  EXPECT_EQ(out.total() * out.elemSize(), packed_bytes(to, kWidth, kHeight));
  convert(picture, to, reinterpret_cast<std::byte*>(out.data));
  return out;
}

double largest_difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF);
}

/// OpenCV's cvtColor reads packed planes.
cv::Mat packed_yuv(const Picture& picture) {
  const PixelFormatInfo& facts = info(picture.format);
  std::vector<std::uint8_t> bytes;
  for (std::size_t p = 0; p < facts.plane_count(); ++p) {
    const int row = (kWidth * facts.planes[p].samples) >> facts.planes[p].shift_x;
    for (int y = 0; y < kHeight >> facts.planes[p].shift_y; ++y) {
      const auto* from = reinterpret_cast<const std::uint8_t*>(picture.planes[p].data) +
                         picture.planes[p].stride * y;
      bytes.insert(bytes.end(), from, from + row);
    }
  }
  const bool one_plane = facts.plane_count() == 1;
  return cv::Mat(one_plane ? kHeight : kHeight * 3 / 2, kWidth, one_plane ? CV_8UC2 : CV_8UC1,
                 bytes.data())
      .clone();
}

struct YuvCase {
  PixelFormat format;
  int opencv;
};

class YuvPictures : public testing::TestWithParam<YuvCase> {};

TEST_P(YuvPictures, HaveTheColoursThatOpenCvFinds) {
  const Noise noise(GetParam().format);
  cv::Mat expected;
  cv::cvtColor(packed_yuv(noise.picture), expected, GetParam().opencv);
  EXPECT_LE(largest_difference(converted(noise.picture, PixelFormat::Rgb), expected), 1);
  cv::Mat swapped;
  cv::cvtColor(converted(noise.picture, PixelFormat::Bgr), swapped, cv::COLOR_BGR2RGB);
  EXPECT_EQ(largest_difference(swapped, converted(noise.picture, PixelFormat::Rgb)), 0);
}

INSTANTIATE_TEST_SUITE_P(All, YuvPictures,
                         testing::Values(YuvCase{PixelFormat::Yuyv, cv::COLOR_YUV2RGB_YUYV},
                                         YuvCase{PixelFormat::Uyvy, cv::COLOR_YUV2RGB_UYVY},
                                         YuvCase{PixelFormat::Nv12, cv::COLOR_YUV2RGB_NV12},
                                         YuvCase{PixelFormat::Nv21, cv::COLOR_YUV2RGB_NV21},
                                         YuvCase{PixelFormat::I420, cv::COLOR_YUV2RGB_I420}),
                         [](const auto& of) {
                           return std::string(orbwatch::info(of.param.format).name);
                         });

TEST(PictureConversion, TakesTheCamerasColourSpaceIntoAccount) {
  Noise noise(PixelFormat::Nv12);
  noise.picture.colour_space = {ColourMatrix::Bt709, ColourRange::Full};
  const cv::Mat rgb = converted(noise.picture, PixelFormat::Rgb);
  const auto* y = reinterpret_cast<const std::uint8_t*>(noise.picture.planes[0].data);
  const auto* uv = reinterpret_cast<const std::uint8_t*>(noise.picture.planes[1].data);
  // ITU-R BT.709: Kr = 0.2126, Kb = 0.0722; the red of the first pixel.
  const double red = std::clamp(y[0] + 2 * (1 - 0.2126) * (uv[1] - 128), 0.0, 255.0);
  EXPECT_NEAR(rgb.at<cv::Vec3b>(0, 0)[0], red, 1);
}

TEST(PictureConversion, GreyOfYuvIsItsLuma) {
  for (const auto format : {PixelFormat::Yuyv, PixelFormat::Uyvy, PixelFormat::Nv12,
                            PixelFormat::Nv21, PixelFormat::I420}) {
    const Noise noise(format);
    const cv::Mat grey = converted(noise.picture, PixelFormat::Grey);
    const int step = info(format).channels(), first = format == PixelFormat::Uyvy ? 1 : 0;
    for (int row = 0; row < kHeight; ++row) {
      for (int x = 0; x < kWidth; ++x) {
        const auto sample = noise.picture.planes[0].data[row * noise.stride + x * step + first];
        ASSERT_EQ(grey.at<std::uint8_t>(row, x), static_cast<std::uint8_t>(sample))
            << info(format).name << " at " << x << ", " << row;
      }
    }
  }
}

TEST(PictureConversion, RgbFormatsKeepTheirColours) {
  const Noise rgb(PixelFormat::Rgb), bgr(PixelFormat::Bgr), bgra(PixelFormat::Bgra),
      deep(PixelFormat::Rgb16);
  const auto mat = [](const Noise& noise, int type) {
    return cv::Mat(kHeight, kWidth, type, const_cast<std::byte*>(noise.picture.planes[0].data),
                   static_cast<std::size_t>(noise.stride));
  };
  cv::Mat expected;
  EXPECT_EQ(largest_difference(converted(rgb.picture, PixelFormat::Rgb), mat(rgb, CV_8UC3)), 0);
  cv::cvtColor(mat(bgr, CV_8UC3), expected, cv::COLOR_BGR2RGB);
  EXPECT_EQ(largest_difference(converted(bgr.picture, PixelFormat::Rgb), expected), 0);
  cv::cvtColor(mat(bgra, CV_8UC4), expected, cv::COLOR_BGRA2RGB);
  EXPECT_EQ(largest_difference(converted(bgra.picture, PixelFormat::Rgb), expected), 0);
  mat(deep, CV_16UC3).convertTo(expected, CV_8U, 1 / 256.0, -0.498);
  EXPECT_EQ(largest_difference(converted(deep.picture, PixelFormat::Rgb), expected), 0);
  cv::cvtColor(mat(rgb, CV_8UC3), expected, cv::COLOR_RGB2GRAY);
  EXPECT_LE(largest_difference(converted(rgb.picture, PixelFormat::Grey), expected), 1);
}

TEST(PictureConversion, LuminanceBecomesGreyAndKeepsItsCounts) {
  for (const auto format :
       {PixelFormat::Grey, PixelFormat::Y10, PixelFormat::Y12, PixelFormat::Y16}) {
    const Noise noise(format);
    const bool wide = info(format).bits > 8;
    const cv::Mat samples(kHeight, kWidth, wide ? CV_16UC1 : CV_8UC1,
                          const_cast<std::byte*>(noise.picture.planes[0].data),
                          static_cast<std::size_t>(noise.stride));
    cv::Mat grey(kHeight, kWidth, CV_8UC1);
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const int x = i % kWidth, y = i / kWidth;
      grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
          wide ? samples.at<std::uint16_t>(y, x) >> (info(format).bits - 8)
               : samples.at<std::uint8_t>(y, x));
    }
    EXPECT_EQ(largest_difference(converted(noise.picture, PixelFormat::Grey), grey), 0);
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2RGB);
    EXPECT_EQ(largest_difference(converted(noise.picture, PixelFormat::Rgb), colour), 0);
    ASSERT_EQ(converts(format, PixelFormat::Y16), wide);
    if (!wide) continue;
    EXPECT_EQ(largest_difference(converted(noise.picture, PixelFormat::Y16), samples), 0);
  }
}

TEST(PictureConversion, ColourHasNoCounts) {
  EXPECT_FALSE(converts(PixelFormat::Rgb16, PixelFormat::Y16));
  EXPECT_FALSE(converts(PixelFormat::Nv12, PixelFormat::Y16));
  EXPECT_FALSE(converts(PixelFormat::Rgb, PixelFormat::Nv12));
}

}  // namespace
}  // namespace orbwatch::app
