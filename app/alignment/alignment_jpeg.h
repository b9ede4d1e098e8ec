// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// A camera's picture as a JPEG file, or the view that it shows through `ball`. One channel is
/// stretched: black is the 1st, white the 99th percentile of the values that the file shows.
/// Reentrant. Error: a view that is impossible, a format that cannot be shown, out of memory.
Result<std::string> alignment_jpeg(const Picture& picture, const optics::BallProjection& ball,
                                   const std::optional<optics::ViewSpec>& view);

}  // namespace orbwatch::app
