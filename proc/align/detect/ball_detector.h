// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The most likely place of a mirror ball in a picture.
struct BallDetection {
  /// The limb, complete even where the picture cuts it. Pixels (OpenCV convention).
  optics::Outline outline;
  /// 0 to 1. proc/align/README.md gives the share of outlines from kConfident on that were right.
  double confidence = 0;
  /// Reason for a confidence below kConfident; else empty.
  std::string reason;

  static constexpr double kConfident = 0.5;
  bool is_confident() const { return confidence >= kConfident; }
};

/// Finds the most likely mirror ball in a picture of any format, colour, grey or thermal, fully or
/// for the most part within it. Needs no calibration: it detects how a ball compresses the
/// reflection towards its limb, and ends there. Takes about a tenth of a second. Reentrant. Error:
/// a picture with a side below 64 pixels, or one without any structure.
Result<BallDetection> detect_ball(const Picture& picture);

}  // namespace orbwatch::align
