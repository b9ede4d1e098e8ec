// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "tests/bench/frame.h"
#include "tests/bench/rig.h"

namespace orbwatch::bench {

/// cv::remap on one thread with maps in its fast form (CV_16SC2 and CV_16UC1), plane by plane,
/// which is the usual way with OpenCV. `source` outlives it.
class OpencvRemap {
 public:
  /// True if planes of that format can be remapped without conversion: not YUYV and UYVY.
  static bool takes(PixelFormat format);

  OpencvRemap(const Rig& rig, const Frame& source);

  void run();
  const Frame& output() const { return output_; }

  struct Maps {
    cv::Mat places, weights;
  };

 private:
  struct Pass {
    cv::Mat source, output;
    Maps maps;
  };

  Frame output_;
  std::vector<Pass> passes_;  ///< one per plane
};

}  // namespace orbwatch::bench
