// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hal/replay/picture_decoder.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Error: a picture that does not have the size that the rig states for its camera; with a note if
/// EXIF exchanged width and height. Reentrant.
Result<> check_picture_size(const hal::DecodedPicture& picture, const optics::RigCamera& camera);

}  // namespace orbwatch::app
