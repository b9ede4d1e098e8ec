#pragma once

#include <string>

#include "app/ports/dds/generated/camera_info.h"
#include "app/ports/dds/participant/time_message.h"
#include "proc/image/result.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

using CameraInfoMessage = sensor_msgs_msg_dds__CameraInfo_;

/// The calibration of a perspective view: a pinhole without distortion, in the optical frame of ROS
/// (REP 103: x right, y down, z into the picture; pixel centres at integers), which is that of the
/// view's picture. The message leads to `frame_id`, which has to outlive it. Errors: as
/// ViewProjection::make; views of other kinds, which no pinhole describes. Reentrant; allocates
/// nothing but errors.
Result<CameraInfoMessage> camera_info(const optics::ViewSpec& view, std::string& frame_id,
                                      const TimeMessage& stamp);

}  // namespace orbwatch::app
