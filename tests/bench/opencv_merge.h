// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "tests/bench/merged_view.h"

namespace orbwatch::bench {

/// A view of two cameras by the usual OpenCV calls, on one thread: NV12 to RGB, cv::remap with maps
/// in its fast form, one-channel pictures through a colour map, 16 bit ones scaled to bytes before,
/// and a blend by weights of full size. The measured thermal counts are coloured afterwards. Reads
/// the cameras, maps and weights of `ours`, which outlives it.
class OpencvMerge {
 public:
  /// True if it can make that view: cv::blendLinear blends two pictures.
  static bool takes(const MergedCase& wanted) { return !wanted.panorama && wanted.count == 2; }

  explicit OpencvMerge(const MergedView& ours);

  void run();

  const cv::Mat& output() const { return out_; }
  const cv::Mat& measured() const { return sources_.back().sampled; }

 private:
  struct Source {
    std::vector<cv::Mat> planes;
    cv::Mat picture;  ///< single-plane picture
    cv::Mat places, map_weights;
    cv::Mat sampled;
    double scale = 1, offset = 0;  ///< from 16 bit counts to bytes
    cv::Mat bytes;
    cv::Mat colours;  ///< 256 colours of a one-channel camera
    cv::Mat shown;
    cv::Mat share;  ///< for each pixel, 0..1
  };

  static Source source_of(const MergedView& ours, std::size_t camera);
  static void show(Source& source);

  std::vector<Source> sources_;
  cv::Mat out_;
};

}  // namespace orbwatch::bench
