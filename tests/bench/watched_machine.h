// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

#include "app/watch/alignment_watch.h"
#include "app/watch/ball_watch.h"

namespace orbwatch::bench {

/// Two cameras as the demo's, watched as the product does: colour, RGB 1000x1000, a ball of 478 px,
/// and thermal, Y16 320x256, a ball of 116 px. Their pictures show a still room with noise, 15 per
/// second. Not reentrant.
class WatchedMachine {
 public:
  static constexpr int kSetsPerSecond = 15;

  /// Takes the references.
  WatchedMachine();
  ~WatchedMachine();
  WatchedMachine(const WatchedMachine&) = delete;
  WatchedMachine& operator=(const WatchedMachine&) = delete;

  /// Looks at the next frame set; false when a camera's alignment is not measured as good.
  bool look();

 private:
  struct Camera {
    app::AlignmentWatch alignment;
    app::BallWatch ball;
    PixelFormat format;
    std::vector<cv::Mat> pictures;
  };

  void add_camera(PixelFormat format, const cv::Size& size, double radius);

  std::filesystem::path folder_;
  std::vector<Camera> cameras_;
  std::size_t sets_ = 0;
};

}  // namespace orbwatch::bench
