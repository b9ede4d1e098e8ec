// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "hal/recording/camera_recording.h"
#include "hal/replay/recording.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Plays the pictures that an MCAP file has of one camera, at their recorded moments. Cameras of
/// one file that start together have its pictures in the recorded order, also when it restarts.
class RecordedPictures : public Recording {
 public:
  /// Errors: those of CameraRecording::open().
  static Result<std::unique_ptr<Recording>> open(const std::filesystem::path& file,
                                                 std::string_view camera, bool loop);

  const StreamFormat& format() const override { return recording_.index().format; }
  std::optional<RecordedMoment> moment(std::uint64_t number) const override;
  DeviceResult<> show(std::uint64_t number, FrameBuffer& target,
                      const std::stop_token& stop) override;

 private:
  RecordedPictures(recording::CameraRecording recording, bool loop)
      : recording_(std::move(recording)), loop_(loop) {}

  recording::CameraRecording recording_;
  bool loop_;
};

}  // namespace orbwatch::hal
