// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/camera.h"
#include "hal/mcap/reader.h"
#include "hal/recording/camera_channels.h"
#include "hal/recording/picture_region.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// An exposure of a camera, and the place of its picture in the recording. Times are nanoseconds
/// of UTC since 1970.
struct RecordedExposure {
  std::uint64_t set_time = 0;  ///< stamp of its frame set
  std::uint64_t start = 0;
  std::uint32_t sequence = 0;            ///< low 32 bits of the frame's number
  std::optional<std::uint64_t> trigger;  ///< trigger of the frame set
  PictureRegion region;
  std::size_t chunk = 0;
  std::size_t message = 0;  ///< number in the chunk
};

/// Time of the pictures of all cameras of a recording: the same whichever camera is indexed.
struct RecordedTime {
  std::uint64_t begin = 0, end = 0;    ///< stamps of the first and the last frame set
  std::chrono::nanoseconds period{0};  ///< mean time between frame sets; 0: there is only one
};

/// Bounds of what a recording of any origin makes a camera keep and wait for.
inline constexpr std::size_t kMostPictures = std::size_t{1} << 20;
inline constexpr std::chrono::hours kLongestRecording{10 * 24};
/// Longest time between an exposure and the stamp of its frame set.
inline constexpr std::chrono::seconds kLongestAge{10};

/// Pictures of one camera of a recording.
struct CameraIndex {
  CameraChannels channels;
  StreamFormat format;  ///< format of the camera's whole picture
  std::vector<RecordedExposure> exposures;
  RecordedTime time;
  std::uint64_t triggers = 0;  ///< from the first to the last one of all frame sets
};

/// Reads the whole recording and checks the camera's messages. Errors: those of channels_of(); a
/// message that picture_of() or place_of() refuses; pictures of another size or format than the
/// first; stamps that go backwards; more than the bounds; no picture; a damaged chunk.
Result<CameraIndex> index_camera(mcap::Reader& reader, std::string_view camera);

}  // namespace orbwatch::hal::recording
