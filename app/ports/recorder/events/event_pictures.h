// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "app/pictures/jpeg_encoder.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "hal/recording/camera_index.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Pictures of recordings for people, one after the other: the index of the recording that was
/// asked for last stays in memory. No file stays open, because a deleted event must free its room.
/// A recording whose summary is damaged is refused, because each picture would cost a scan of the
/// whole. Thread-safe.
class EventPictures {
 public:
  /// The moments of all pictures, by camera. Errors: those of hal::mcap::Reader::open_finished()
  /// and hal::recording::index_camera().
  Result<std::vector<RecordedFrames>> frames(const std::filesystem::path& recording) const;

  /// One picture as JPEG: the recorded part; 16 bit stretched as jpeg_for_people() does. Errors:
  /// those of frames() and of hal::recording::CameraRecording; there is no such picture, or it is
  /// larger than 64 MiB.
  Result<std::string> jpeg(const std::filesystem::path& recording, std::string_view camera,
                           std::size_t frame);

 private:
  struct Indexed {
    std::filesystem::path recording;
    std::string camera;
    std::shared_ptr<const hal::recording::CameraIndex> index;
  };

  Result<std::shared_ptr<const hal::recording::CameraIndex>> index_of(
      const std::filesystem::path& recording, std::string_view camera);

  std::mutex mutex_;  ///< guards the members below
  std::optional<Indexed> indexed_;
  hal::JpegDecoder decoder_;
  std::vector<std::byte> pixels_;  ///< the part that was shown last
  JpegEncoder encoder_;
};

}  // namespace orbwatch::app::recorder
