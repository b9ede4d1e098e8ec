// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "hal/camera.h"
#include "hal/recording/picture_region.h"
#include "proc/optics/lens.h"

namespace orbwatch::app {

/// A camera whose pictures may be recorded.
struct RecordedCamera {
  std::string name;
  hal::StreamFormat format;                ///< as far as it is known
  hal::recording::PictureRegion ball;      ///< around the ball, inside of a picture of that format
  std::optional<optics::Intrinsics> lens;  ///< nullopt: not calibrated
};

}  // namespace orbwatch::app
