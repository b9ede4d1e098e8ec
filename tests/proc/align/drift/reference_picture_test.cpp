// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/reference_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

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

}  // namespace
}  // namespace orbwatch::align
