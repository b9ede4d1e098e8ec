// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/files/resolve.h"
#include "app/model/sink/recorded_camera.h"
#include "hal/camera.h"

namespace orbwatch::app::daemon {

/// The cameras of a site, by place in its names, with the part of their pictures around the ball:
/// its limb and a margin, the whole picture where the rig does not state it. `formats` by camera.
/// Reentrant.
std::vector<RecordedCamera> recorded_cameras(const files::Resolved& site,
                                             const std::vector<hal::StreamFormat>& formats);

}  // namespace orbwatch::app::daemon
