// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/ports/dds/generated/camera_info.h"
#include "app/ports/dds/participant/time_message.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::dds {

using CameraInfoMessage = sensor_msgs_msg_dds__CameraInfo_;

/// The calibration of a picture of this lens, in the optical frame of ROS (REP 103: x right, y
/// down, z into the picture; pixel centres at integers). Its rectified picture keeps the camera
/// matrix. The message points to `lens` and `frame_id`, which must outlive it. Reentrant.
CameraInfoMessage camera_info(const optics::Intrinsics& lens, const std::string& frame_id,
                              const TimeMessage& stamp);

/// The pinhole camera without distortion that is equivalent to a perspective view. Errors: those of
/// ViewProjection::make; views of other kinds. Reentrant; allocates nothing but errors.
Result<optics::Intrinsics> lens_of(const optics::ViewSpec& view);

}  // namespace orbwatch::app::dds
