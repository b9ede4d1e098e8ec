// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/tags/tag_detector.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbwatch::align {
namespace {

/// More wrong bits would let a room's pattern pass as a tag.
constexpr int kMostWrongBits = 1;

/// The library's corners are, as in its own pictures, bottom left, bottom right, top right, top
/// left; OpenCV's pictures are turned by 180 degrees.
constexpr std::array<int, 4> kCornerOrder{1, 0, 3, 2};

/// Moves corners to where the edges beside them meet: the detector's are up to half a pixel off.
void refine(const cv::Mat& view, std::array<cv::Point2f, 4>& corners) {
  constexpr double kCells = 8;  // of a tag's side
  double shortest = cv::norm(corners[3] - corners[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    shortest = std::min(shortest, cv::norm(corners[k + 1] - corners[k]));
  }
  // A window of more than a cell would hold edges of bits.
  const int half = std::clamp(int(shortest / kCells * 0.7), 1, 5);
  cv::cornerSubPix(view, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01});
}

}  // namespace

TagDetector::TagDetector()
    : family_(tag36h11_create(), tag36h11_destroy),
      detector_(apriltag_detector_create(), apriltag_detector_destroy) {
  apriltag_detector_add_family_bits(detector_.get(), family_.get(), kMostWrongBits);
  detector_->quad_decimate = 1;  // full resolution
}

std::vector<TagInView> TagDetector::detect(const cv::Mat& view) {
  const cv::Mat pixels = view.isContinuous() ? view : view.clone();
  image_u8_t image{pixels.cols, pixels.rows, int(pixels.step), pixels.data};
  const std::unique_ptr<zarray_t, void (*)(zarray_t*)> found(
      apriltag_detector_detect(detector_.get(), &image), apriltag_detections_destroy);
  std::vector<TagInView> tags;
  for (int n = 0; n < zarray_size(found.get()); ++n) {
    apriltag_detection_t* one = nullptr;
    zarray_get(found.get(), n, static_cast<void*>(&one));
    TagInView tag{one->id, {}};
    for (std::size_t k = 0; k < 4; ++k) {
      constexpr double kMiddle = 0.5;  // the library's coordinates of a pixel's centre
      const double* const at = one->p[kCornerOrder[k]];
      tag.corners[k] = cv::Point2f(cv::Point2d(at[0] - kMiddle, at[1] - kMiddle));
    }
    refine(pixels, tag.corners);
    tags.push_back(tag);
  }
  return tags;
}

}  // namespace orbwatch::align
