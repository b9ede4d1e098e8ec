#pragma once

#include <string_view>

#include "app/dds/idl/compressed_image.h"

namespace orbwatch::app {

using CompressedImageMessage = sensor_msgs_msg_dds__CompressedImage_;

/// What ROS' image_transport writes into `format`: what the picture was; how it was compressed, and
/// as what. Of literals, so zero-terminated.
inline constexpr std::string_view kColourJpeg = "rgb8; jpeg compressed bgr8";
inline constexpr std::string_view kGreyJpeg = "mono8; jpeg compressed mono8";

}  // namespace orbwatch::app
