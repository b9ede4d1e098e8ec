// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "proc/align/detect/ball_detector.h"
#include "proc/optics/outline.h"

namespace orbwatch::app::cli {

/// A ball in a picture.
struct DetectedBall {
  int width = 0;  ///< px, of the picture
  int height = 0;
  align::BallDetection detection;
  std::optional<optics::BallSight> sight;  ///< if the lens is known
};

/// For people: what was found, how sure that is, and the keys of the rig file that state it.
std::string detect_text(const DetectedBall& ball);

/// One JSON object (RFC 8259), as documented in `orbwatch detect --help`.
std::string detect_json(const DetectedBall& ball);

}  // namespace orbwatch::app::cli
