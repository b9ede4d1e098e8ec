// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "app/model/status/status.h"
#include "proc/image/picture.h"
#include "proc/optics/outline.h"

namespace orbwatch::app {

/// A stated outline compared with the ball found in a picture.
struct OutlineCheck {
  OutlineState state = OutlineState::Unknown;
  std::string doubt;                           ///< why it is unknown
  double offset_px = signals::kNotValid;       ///< largest distance between both limbs
  double offset_percent = signals::kNotValid;  ///< the same, relative to the stated radius
};

/// A picture of the ball, and where the rig states its outline there.
struct OutlineSubject {
  cv::Mat luminance;  ///< as luminance_of()
  PixelFormat format = PixelFormat::Grey;
  optics::Outline stated;
};

/// Looks for the ball anywhere in the picture: some tenths of a second. Reentrant.
OutlineCheck check_outline(const Picture& picture, const optics::Outline& stated);

}  // namespace orbwatch::app
