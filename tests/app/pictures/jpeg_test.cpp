// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/jpeg_quality.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {
namespace {

/// Smooth picture with some detail, which JPEG preserves well.
cv::Mat scene(int width, int height, double detail = 20) {
  cv::Mat rgb(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double wave = detail * std::sin(x * 0.7) * std::cos(y * 0.9);
      rgb.at<cv::Vec3b>(y, x) = {cv::saturate_cast<std::uint8_t>(200.0 * x / width + wave),
                                 cv::saturate_cast<std::uint8_t>(180.0 * y / height + wave),
                                 cv::saturate_cast<std::uint8_t>(90 + wave)};
    }
  }
  return rgb;
}

Picture picture(const cv::Mat& mat, PixelFormat format) {
  return Picture::contiguous(format, mat.cols, mat.rows,
                             reinterpret_cast<const std::byte*>(mat.data),
                             static_cast<std::ptrdiff_t>(mat.step));
}

cv::Mat decoded(std::span<const std::uint8_t> jpeg) {
  return cv::imdecode(
      cv::Mat(1, static_cast<int>(jpeg.size()), CV_8UC1, const_cast<std::uint8_t*>(jpeg.data())),
      cv::IMREAD_UNCHANGED);
}

TEST(JpegEncoder, ColoursComeBack) {
  const cv::Mat rgb = scene(161, 91);
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  JpegEncoder encoder;
  for (const auto& [mat, format] :
       {std::pair{rgb, PixelFormat::Rgb}, std::pair{bgr, PixelFormat::Bgr}}) {
    const auto jpeg = encoder.encode(picture(mat, format), 95);
    ASSERT_TRUE(jpeg) << jpeg.error().message;
    const cv::Mat read = decoded(*jpeg);
    ASSERT_EQ(read.size(), bgr.size());
    EXPECT_LT(cv::norm(read, bgr, cv::NORM_L1) / (3.0 * static_cast<double>(bgr.total())), 3);
  }
}

TEST(JpegEncoder, LuminanceStaysOneChannel) {
  cv::Mat grey, counts;
  cv::cvtColor(scene(64, 48), grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(counts, CV_16U, 256);
  JpegEncoder encoder;
  for (const auto& [mat, format] :
       {std::pair{grey, PixelFormat::Grey}, std::pair{counts, PixelFormat::Y16}}) {
    const auto jpeg = encoder.encode(picture(mat, format), 95);
    ASSERT_TRUE(jpeg) << jpeg.error().message;
    const cv::Mat read = decoded(*jpeg);
    ASSERT_EQ(read.type(), CV_8UC1);
    EXPECT_LE(cv::norm(read, grey, cv::NORM_INF), 12);
  }
}

/// Planes of JPEG's layout, as a view is rendered for it.
struct Planar {
  explicit Planar(const cv::Mat& rgb) {
    cv::cvtColor(rgb, samples, cv::COLOR_RGB2YUV_I420);  // limited range
    picture = Picture::contiguous(PixelFormat::I420, rgb.cols, rgb.rows,
                                  reinterpret_cast<const std::byte*>(samples.data), rgb.cols);
    for (int y = 0; y < samples.rows; ++y) {
      for (int x = 0; x < samples.cols; ++x) {
        auto& sample = samples.at<std::uint8_t>(y, x);
        sample = cv::saturate_cast<std::uint8_t>(y < rgb.rows ? (sample - 16) * 255.0 / 219
                                                              : (sample - 128) * 255.0 / 224 + 128);
      }
    }
    picture.colour_space = remap::kJfif;
  }
  cv::Mat samples;
  Picture picture;
};

TEST(JpegEncoder, PlanesOfItsOwnKindAreCompressedAsTheyAre) {
  const cv::Mat rgb = scene(160, 90);
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  const Planar planar(rgb);
  JpegEncoder encoder;
  const auto jpeg = encoder.encode(planar.picture, 95);
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  const cv::Mat read = decoded(*jpeg);
  ASSERT_EQ(read.size(), bgr.size());
  EXPECT_LT(cv::norm(read, bgr, cv::NORM_L1) / (3.0 * static_cast<double>(bgr.total())), 3);
}

TEST(JpegEncoder, TakesOtherFormatsAndSizesOneAfterTheOther) {
  JpegEncoder encoder;
  for (const int side : {16, 640, 2}) {
    const std::vector<std::byte> samples(static_cast<std::size_t>(side) * side * 3 / 2,
                                         std::byte{128});
    const auto jpeg = encoder.encode(
        Picture::contiguous(PixelFormat::Nv12, side, side, samples.data(), side), 80);
    ASSERT_TRUE(jpeg) << jpeg.error().message;
    const cv::Mat read = decoded(*jpeg);
    ASSERT_EQ(read.rows, side);
    EXPECT_NEAR(read.at<cv::Vec3b>(0, 0)[1], (128 - 16) * 255 / 219, 2);
  }
}

/// Encodes one picture like a topic does; returns its size.
std::size_t make(JpegEncoder& encoder, JpegQuality& quality, const Picture& source) {
  auto jpeg = encoder.encode(source, quality.current());
  while (jpeg && quality.adapt(jpeg->size())) jpeg = encoder.encode(source, quality.current());
  return jpeg ? jpeg->size() : 0;
}

TEST(JpegQuality, KeepsPicturesBelowTheirTargetFromTheFirstOn) {
  const cv::Mat rgb = scene(640, 360, 60);
  JpegEncoder encoder;
  JpegQuality free({.quality = 95});
  const std::size_t large = make(encoder, free, picture(rgb, PixelFormat::Rgb));
  EXPECT_EQ(free.current(), 95) << "no target, no change";
  for (const std::size_t target : {large / 2, large / 4}) {
    JpegQuality quality({.quality = 95, .target_bytes = target});
    for (int i = 0; i < 200; ++i) {
      const std::size_t size = make(encoder, quality, picture(rgb, PixelFormat::Rgb));
      ASSERT_GT(size, 0u);
      ASSERT_LE(size, target) << "picture " << i;
    }
    EXPECT_GT(make(encoder, quality, picture(rgb, PixelFormat::Rgb)), target / 2)
        << "uses the room that it has";
  }
}

TEST(JpegQuality, RecoversWhenTheSceneBecomesSimple) {
  const cv::Mat rich = scene(320, 240, 90), plain = scene(320, 240, 0);
  JpegEncoder encoder;
  JpegQuality free({.quality = 90});
  JpegQuality quality(
      {.quality = 90, .target_bytes = make(encoder, free, picture(rich, PixelFormat::Rgb)) / 3});
  make(encoder, quality, picture(rich, PixelFormat::Rgb));
  const int under_load = quality.current();
  EXPECT_LT(under_load, 90);
  for (int i = 0; i < 100; ++i) make(encoder, quality, picture(plain, PixelFormat::Rgb));
  EXPECT_EQ(quality.current(), 90) << "never better than asked for";
}

TEST(JpegQuality, AnImpossibleTargetEndsAtTheLeastQuality) {
  const cv::Mat rgb = scene(320, 240, 90);
  JpegEncoder encoder;
  JpegQuality quality({.quality = 90, .target_bytes = 100});
  for (int i = 0; i < 5; ++i) EXPECT_GT(make(encoder, quality, picture(rgb, PixelFormat::Rgb)), 0u);
  EXPECT_EQ(quality.current(), JpegQuality::kLeast);
}

}  // namespace
}  // namespace orbwatch::app
