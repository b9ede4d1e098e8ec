// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "hal/camera.h"
#include "hal/mcap/record.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// Facts about a camera's pictures that the messages of ROS 2 do not have, as metadata of the
/// channel of pictures: pixel format, colour space, frame rate and scale of temperatures. The
/// sides of `format` are not among them; see CameraInfo.
mcap::StringMap metadata_of(const StreamFormat& format);

/// The same from a channel of any origin; without an entry, a member of `format` stays as it is.
/// Entries with other names are ignored. Errors: a value that the entry cannot have. Reentrant.
Result<> read_metadata(const mcap::StringMap& metadata, StreamFormat& format);

/// Entry with the quality of JPEG that a recorder coded.
inline constexpr std::string_view kJpegQuality = "jpeg_quality";

/// Quality, 1 to 100, in a channel's metadata of any origin; nullopt: none is stated, since
/// pictures are lossless, or JPEG data is what a camera sent. Reentrant.
std::optional<int> jpeg_quality_in(const mcap::StringMap& metadata);

}  // namespace orbwatch::hal::recording
