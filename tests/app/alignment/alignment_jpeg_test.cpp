// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_jpeg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "proc/optics/rotation.h"

namespace orbwatch::app {
namespace {

constexpr int kViewSide = 200;

optics::BallProjection ball() {
  const auto model = optics::BallModel::make(optics::BallModel::Kind::Exact, {}, 12).value();
  return optics::BallProjection::make(model, {{99.5, 99.5}, 80, 80, 0}, {}).value();
}

cv::Mat decoded(const std::string& jpeg) {
  return cv::imdecode(std::vector<std::uint8_t>(jpeg.begin(), jpeg.end()), cv::IMREAD_UNCHANGED);
}

/// Counts of a room at `base`, its right half 100 counts warmer, with one spot far above.
std::vector<std::uint16_t> counts(std::uint16_t base) {
  std::vector<std::uint16_t> samples(kViewSide * kViewSide, base);
  for (int v = 0; v < kViewSide; ++v) {
    for (int u = kViewSide / 2; u < kViewSide; ++u) {
      samples[static_cast<std::size_t>(v * kViewSide + u)] = static_cast<std::uint16_t>(base + 100);
    }
  }
  samples[kViewSide * kViewSide / 2] = 65535;
  return samples;
}

Picture picture(std::vector<std::uint16_t>& samples) {
  return picture_of(PixelFormat::Y16,
                    ImageView<std::uint16_t>{samples.data(), kViewSide, kViewSide, 1, kViewSide});
}

/// Makes the first pixels hot, a share of all.
template <class Sample>
void heat(std::vector<Sample>& samples, double share) {
  std::fill_n(samples.begin(), std::lround(share * static_cast<double>(samples.size())),
              std::numeric_limits<Sample>::max());
}

TEST(AlignmentJpeg, AMeltPoolDoesNotDarkenTheRoom) {
  auto samples = counts(7400);
  heat(samples, 0.008);
  const auto jpeg = alignment_jpeg(picture(samples), ball(), {});
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  const cv::Mat shown = decoded(*jpeg);
  EXPECT_LT(shown.at<std::uint8_t>(100, 20), 10);
  EXPECT_GT(shown.at<std::uint8_t>(100, 180), 245);
}

TEST(AlignmentJpeg, EightBitsAreStretched) {
  std::vector<std::uint8_t> samples(kViewSide * kViewSide, 20);
  std::fill(samples.begin() + kViewSide * kViewSide / 2, samples.end(), std::uint8_t{28});
  const ImageView<std::uint8_t> dark{samples.data(), kViewSide, kViewSide, 1, kViewSide};
  const auto jpeg = alignment_jpeg(picture_of(PixelFormat::Grey, dark), ball(), {});
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  const cv::Mat shown = decoded(*jpeg);
  EXPECT_LT(shown.at<std::uint8_t>(50, 100), 10);
  EXPECT_GT(shown.at<std::uint8_t>(150, 100), 245);
}

TEST(AlignmentJpeg, OfCountsTheRangeThatIsThereIsShown) {
  for (const std::uint16_t base : {100, 7400, 60000}) {
    auto samples = counts(base);
    const auto jpeg = alignment_jpeg(picture(samples), ball(), {});
    ASSERT_TRUE(jpeg) << jpeg.error().message;
    const cv::Mat shown = decoded(*jpeg);
    ASSERT_EQ(shown.size(), cv::Size(kViewSide, kViewSide));
    EXPECT_LT(shown.at<std::uint8_t>(20, 20), 10) << base;
    EXPECT_GT(shown.at<std::uint8_t>(20, 180), 245) << base;
  }
}

TEST(AlignmentJpeg, AWholePictureHasTheSidesThatAreAskedFor) {
  auto samples = counts(7400);
  AlignmentPicture asked;
  asked.width = asked.height = kViewSide / 2;
  const auto jpeg = alignment_jpeg(picture(samples), ball(), asked);
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  const cv::Mat shown = decoded(*jpeg);
  ASSERT_EQ(shown.size(), cv::Size(kViewSide / 2, kViewSide / 2));
  EXPECT_LT(shown.at<std::uint8_t>(10, 10), 10);
  EXPECT_GT(shown.at<std::uint8_t>(10, 90), 245);
  asked.width = asked.height = 2 * kViewSide;
  const auto own = alignment_jpeg(picture(samples), ball(), asked);
  ASSERT_TRUE(own) << own.error().message;
  EXPECT_EQ(decoded(*own).size(), cv::Size(kViewSide, kViewSide)) << "never enlarged";
}

TEST(AlignmentJpeg, ColoursOfAnyFormatAreScaled) {
  constexpr std::array<std::uint8_t, 4> kBlue{240, 41, 110, 41}, kRed{90, 81, 240, 81};
  std::vector<std::uint8_t> samples;  // pairs of pixels, blue on the left, red on the right
  for (int n = 0; n < kViewSide * kViewSide / 2; ++n) {
    const auto& pair = n % (kViewSide / 2) < kViewSide / 4 ? kBlue : kRed;
    samples.insert(samples.end(), pair.begin(), pair.end());
  }
  const Picture camera = Picture::contiguous(PixelFormat::Uyvy, kViewSide, kViewSide,
                                             reinterpret_cast<const std::byte*>(samples.data()),
                                             row_bytes(PixelFormat::Uyvy, kViewSide));
  AlignmentPicture asked;
  asked.width = asked.height = kViewSide / 4;
  const auto jpeg = alignment_jpeg(camera, ball(), asked);
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  const cv::Mat bgr = decoded(*jpeg);
  ASSERT_EQ(bgr.size(), cv::Size(kViewSide / 4, kViewSide / 4));
  const auto blue = bgr.at<cv::Vec3b>(25, 5), red = bgr.at<cv::Vec3b>(25, 45);
  EXPECT_GT(blue[0], 200);
  EXPECT_LT(blue[2], 60);
  EXPECT_GT(red[2], 200);
  EXPECT_LT(red[0], 60);
}

optics::ViewSpec ahead() {
  optics::ViewSpec spec;
  spec.h_fov = 90;
  spec.width = 120;
  spec.height = 80;
  return spec;
}

AlignmentPicture as_view(const optics::ViewSpec& spec) {
  AlignmentPicture asked;
  asked.view = spec;
  return asked;
}

/// Yaw 0 looks back at the camera; what is right of the camera's picture, seen in a mirror, is left
/// of the view.
TEST(AlignmentJpeg, AViewIsMadeThroughTheBall) {
  auto samples = counts(7400);
  const auto jpeg = alignment_jpeg(picture(samples), ball(), as_view(ahead()));
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  const cv::Mat shown = decoded(*jpeg);
  ASSERT_EQ(shown.size(), cv::Size(120, 80));
  EXPECT_GT(shown.at<std::uint8_t>(20, 10), 245);
  EXPECT_LT(shown.at<std::uint8_t>(20, 110), 10);
}

TEST(AlignmentJpeg, AViewIsStretchedByItsOwnValues) {
  auto samples = counts(7400);
  heat(samples, 0.05);  // beside the ball
  const auto jpeg = alignment_jpeg(picture(samples), ball(), as_view(ahead()));
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  const cv::Mat shown = decoded(*jpeg);
  EXPECT_GT(shown.at<std::uint8_t>(20, 10), 245);
  EXPECT_LT(shown.at<std::uint8_t>(20, 110), 10);
}

TEST(AlignmentJpeg, AnImpossibleViewIsRefused) {
  auto samples = counts(7400);
  optics::ViewSpec spec;
  spec.h_fov = 180;
  spec.width = spec.height = 80;
  EXPECT_FALSE(alignment_jpeg(picture(samples), ball(), as_view(spec)));
}

}  // namespace
}  // namespace orbwatch::app
