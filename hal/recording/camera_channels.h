// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/mcap/summary.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// Channels of one camera in a recording.
struct CameraChannels {
  mcap::Channel pictures;
  bool is_jpeg = false;
  std::optional<std::uint16_t> info;  ///< channel of CameraInfo; absent: the pictures are whole
};

/// Type of a channel's messages; empty: not plain CDR with a schema.
std::string_view type_of(const mcap::Summary& summary, const mcap::Channel& channel);

/// True for channels of pictures, of any camera.
bool has_pictures(const mcap::Summary& summary, const mcap::Channel& channel);

/// Names of the cameras that the recording has pictures of, each once.
std::vector<std::string> cameras_in(const mcap::Summary& summary);

/// Channels of a camera, lossless ones before JPEG. Errors: no pictures of it; two channels of
/// them. Reentrant.
Result<CameraChannels> channels_of(const mcap::Summary& summary, std::string_view camera);

}  // namespace orbwatch::hal::recording
