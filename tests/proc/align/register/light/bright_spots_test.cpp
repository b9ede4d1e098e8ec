// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/light/bright_spots.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/picture_of_mat.h"

namespace orbwatch::align {
namespace {

/// A fixed scene with a lamp, noise, and one light that moves 10 px per picture.
std::vector<cv::Mat> process(int type, double light) {
  std::vector<cv::Mat> all;
  for (int n = 0; n < 8; ++n) {
    cv::Mat scene(100, 160, type, cv::Scalar(40));
    cv::rectangle(scene, {100, 60, 20, 20}, cv::Scalar(light), cv::FILLED);
    cv::Mat noise(scene.size(), CV_16S);
    cv::setRNGSeed(n + 1);
    cv::randn(noise, 0, 1);
    cv::add(scene, noise, scene, cv::noArray(), scene.type());
    cv::circle(scene, {20 + 10 * n, 30}, 2, cv::Scalar(light), cv::FILLED);
    all.push_back(scene);
  }
  return all;
}

TEST(BrightSpots, AreWhatMovesNotWhatIsAlwaysBright) {
  for (const auto& pixels : {process(CV_8U, 250), process(CV_16U, 40'000)}) {
    const auto found = bright_spots(tests::pictures_of_mats(pixels), std::nullopt);
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_EQ(found->size(), pixels.size());
    for (std::size_t n = 0; n < found->size(); ++n) {
      ASSERT_EQ((*found)[n].size(), 1U) << n;
      EXPECT_NEAR((*found)[n][0].centre.u, 20.0 + 10.0 * static_cast<double>(n), 0.1);
      EXPECT_NEAR((*found)[n][0].centre.v, 30, 0.1);
    }
  }
}

/// Light beside the ball is ten times as bright as its spot, and would hide it by its share of the
/// peak.
TEST(BrightSpots, AreWithinTheLimb) {
  const optics::Outline limb{{60, 40}, 50, 30, 0};
  auto pixels = process(CV_16U, 4'000);
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const cv::Point beside(20 + 15 * static_cast<int>(n), 90);
    cv::circle(pixels[n], beside, 3, cv::Scalar(40'000), cv::FILLED);
  }
  const auto found = bright_spots(tests::pictures_of_mats(pixels), limb);
  ASSERT_TRUE(found) << found.error().message;
  for (std::size_t n = 0; n < found->size(); ++n) {
    ASSERT_EQ((*found)[n].size(), 1U) << n;
    EXPECT_NEAR((*found)[n][0].centre.u, 20.0 + 10.0 * static_cast<double>(n), 0.1);
    EXPECT_NEAR((*found)[n][0].centre.v, 30, 0.1);
  }
}

TEST(BrightSpots, RefuseShortAndMixedSequences) {
  auto pixels = process(CV_8U, 250);
  const auto all = tests::pictures_of_mats(pixels);
  EXPECT_FALSE(bright_spots(std::span(all).first(kLeastPictures - 1), std::nullopt));
  pixels[3] = cv::Mat(50, 50, CV_8U, cv::Scalar(0));
  EXPECT_FALSE(bright_spots(tests::pictures_of_mats(pixels), std::nullopt));
}

}  // namespace
}  // namespace orbwatch::align
