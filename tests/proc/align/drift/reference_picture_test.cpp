// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/reference_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include "proc/align/drift/fault.h"
#include "proc/align/drift/patch_window.h"
#include "tests/support/picture_of_mat.h"

namespace orbwatch::align {
namespace {

TEST(ReferencePicture, IsTheMedianOfItsPictures) {
  cv::RNG random(6);
  ReferencePicture reference(1);
  std::vector<cv::Mat> smoothed;
  for (std::size_t n = 0; n < ReferencePicture::kPictures; ++n) {
    cv::Mat pixels(30, 40, CV_8U);
    random.fill(pixels, cv::RNG::UNIFORM, 0, 256);
    reference.add(tests::picture_of_mat(pixels));
    smoothed.push_back(smoothed_luminance(tests::picture_of_mat(pixels), 1));
    std::vector<float> sorted(smoothed.size());
    const cv::Mat median = reference.median();
    for (int i = 0; i < 30 * 40; ++i) {
      const cv::Point place(i % 40, i / 40);
      for (std::size_t k = 0; k < sorted.size(); ++k) sorted[k] = smoothed[k].at<float>(place);
      std::ranges::sort(sorted);
      ASSERT_EQ(median.at<float>(place), sorted[sorted.size() / 2]) << n << ' ' << place;
    }
  }
  EXPECT_TRUE(reference.is_complete());
}

/// The fault of a ball whose brightness is `ball` and a little noise, on ground of one brightness.
/// The ball is a little larger than the limb: smoothing would blend the limb with the ground.
std::string_view fault_of_ball(double ball, double ground) {
  const optics::Outline limb{{120, 200}, 60, 50, 20};
  cv::Mat pixels(300, 480, CV_8U, cv::Scalar(ground)), texture(pixels.size(), CV_8U);
  cv::Mat mask(pixels.size(), CV_8U, cv::Scalar(0));
  cv::RNG random(8);
  random.fill(texture, cv::RNG::NORMAL, ball, 2);
  cv::ellipse(mask, {120, 200}, {63, 53}, limb.angle, 0, 360, cv::Scalar(255), cv::FILLED);
  texture.copyTo(pixels, mask);
  return exposure_fault(tests::picture_of_mat(pixels), limb);
}

TEST(ExposureFault, IsThatOfTheBallOnAnyGround) {
  for (const double ground : {0, 90, 255}) {
    SCOPED_TRACE(ground);
    EXPECT_EQ(fault_of_ball(50, ground), "");
    EXPECT_EQ(fault_of_ball(200, ground), "");
    EXPECT_EQ(fault_of_ball(0, ground), fault::kDark);
    EXPECT_EQ(fault_of_ball(300, ground), fault::kOverexposed);
  }
}

}  // namespace
}  // namespace orbwatch::align
