// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "app/pictures/jpeg_encoder.h"
#include "hal/recording/camera_recording.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Pictures of recordings for people, one after the other: the recording that was asked for last
/// stays open. Thread-safe.
class EventPictures {
 public:
  /// The moments of all pictures, by camera. Errors: those of hal::recording::CameraRecording.
  Result<std::vector<RecordedFrames>> frames(const std::filesystem::path& recording) const;

  /// One picture as JPEG: the recorded part; 16 bit stretched as jpeg_for_people() does. Errors:
  /// those of hal::recording::CameraRecording; there is no such picture.
  Result<std::string> jpeg(const std::filesystem::path& recording, std::string_view camera,
                           std::size_t frame);

 private:
  struct Opened {
    std::filesystem::path recording;
    std::string camera;
    hal::recording::CameraRecording pictures;
  };

  Result<Opened*> open(const std::filesystem::path& recording, std::string_view camera);

  std::mutex mutex_;  ///< guards the members below
  std::optional<Opened> opened_;
  std::vector<std::byte> whole_;
  JpegEncoder encoder_;
};

}  // namespace orbwatch::app::recorder
