// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

struct apriltag_detector;
struct apriltag_family;

namespace orbwatch::align {

/// A tag in a perspective view. Corners of its black border as in OpenCV's pictures of tags: top
/// left, top right, bottom right, bottom left; pixels, centres at integers.
struct TagInView {
  int id = 0;
  std::array<cv::Point2f, 4> corners;
};

/// The AprilTag project's detector for the family 36h11. Not thread-safe.
class TagDetector {
 public:
  TagDetector();

  /// `view`: one channel of 8 bit.
  std::vector<TagInView> detect(const cv::Mat& view);

 private:
  std::unique_ptr<apriltag_family, void (*)(apriltag_family*)> family_;
  std::unique_ptr<apriltag_detector, void (*)(apriltag_detector*)> detector_;
};

}  // namespace orbwatch::align
