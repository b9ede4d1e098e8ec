// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hal/mcap/fields.h"
#include "hal/recording/messages.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// Encoding of pictures in this format: those of ROS 2 (sensor_msgs/image_encodings.hpp), where it
/// has one; nv12 and i420 by their usual names. 10 and 12 bits are mono16 as well. Reentrant.
std::string_view encoding_of(PixelFormat format);

/// A message with the pixels of `part`, without padding and one plane after another; `pixels`,
/// which is replaced, receives them and must outlive the message. Reentrant.
Image image_of(const Picture& part, Header header, mcap::Bytes& pixels);

/// The picture in a message of any origin, whose pixels stay there, of any alignment. mono16 is
/// `grey16`: Y10, Y12 or Y16, see read_metadata(). Errors: an unknown encoding; sides of 0, above
/// kMaxSide or odd where pixels share chroma; big-endian samples; a step that is too short, or that
/// 16-bit samples or chroma cannot have; another number of bytes than sides and step make.
/// Reentrant.
Result<Picture> picture_of(const Image& message, PixelFormat grey16 = PixelFormat::Y16);

}  // namespace orbwatch::hal::recording
