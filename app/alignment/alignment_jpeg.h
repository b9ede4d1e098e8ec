// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/model/alignment/alignment.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"

namespace orbwatch::app {

/// A camera's picture as a JPEG file, or the view that it shows through `ball`, as `asked` for. One
/// channel is stretched: black is the 1st, white the 99th percentile of the values that the file
/// shows. Reentrant. Error: a view that is impossible, a format that cannot be shown, out of
/// memory.
Result<std::string> alignment_jpeg(const Picture& picture, const optics::BallProjection& ball,
                                   const AlignmentPicture& asked);

}  // namespace orbwatch::app
