#pragma once

#include <string>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// Where a picture may show a mirror ball.
struct BallDetection {
  /// The limb, full also where the picture cuts it. Pixels (OpenCV convention).
  optics::Outline outline;
  /// 0 to 1. proc/align/README.md says how often outlines from kConfident on were right.
  double confidence = 0;
  /// What speaks against it when it is below kConfident; else empty.
  std::string reason;

  static constexpr double kConfident = 0.5;
  bool is_confident() const { return confidence >= kConfident; }
};

/// The most likely mirror ball in a picture of any format, colour, grey or thermal, fully or for
/// the most part within it. Needs no calibration: it goes by how a ball compresses what it
/// reflects towards its limb, and ends there. Takes about a tenth of a second. Reentrant.
/// Error: a picture with a side below 64 pixels, or one that shows nothing at all.
Result<BallDetection> detect_ball(const Picture& picture);

}  // namespace orbwatch::align
