// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/recorded_states.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "hal/recording/camera_recording.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// The recorded part of a picture, and what was reported of its frame set.
struct ExportedPicture {
  hal::recording::RecordedExposure exposure;
  hal::recording::RecordedPart part;
  const ProcessState* state = nullptr;  ///< null: not recorded
};

/// The pictures of one camera in a range of a recording of any origin, one in memory at a time.
/// Thread-bound.
class CameraPictures {
 public:
  /// `camera`: may be empty if the recording has one alone. Errors: another number of cameras;
  /// those of CameraRecording and RecordedStates; no picture in the range.
  static Result<CameraPictures> open(const std::filesystem::path& recording,
                                     const std::string& camera, const StampRange& range);

  const std::string& camera() const { return camera_; }
  const hal::recording::CameraIndex& index() const { return pictures_.index(); }
  /// Those in the range.
  std::span<const hal::recording::RecordedExposure> exposures() const {
    return std::span(index().exposures).subspan(begin_, end_ - begin_);
  }
  std::size_t count() const { return end_ - begin_; }
  bool is_done() const { return next_ == end_; }
  /// Begins again with the first picture.
  Result<> rewind();

  /// The next picture, valid until the next call. Errors: damaged; the disk.
  Result<ExportedPicture> next();
  /// Pixels of a picture, aligned and without padding, valid until the next call. Errors: damaged
  /// JPEG, or one of a size beyond the limits of recordings.
  Result<Picture> pixels(const ExportedPicture& picture);

 private:
  CameraPictures(std::filesystem::path file, std::string camera,
                 hal::recording::CameraRecording pictures, RecordedStates states)
      : file_(std::move(file)),
        camera_(std::move(camera)),
        pictures_(std::move(pictures)),
        states_(std::move(states)) {}

  Result<const ProcessState*> state_at(std::uint64_t stamp);

  std::filesystem::path file_;
  std::string camera_;
  hal::recording::CameraRecording pictures_;
  RecordedStates states_;
  std::optional<RecordedState> state_;  ///< read last
  std::size_t begin_ = 0, end_ = 0, next_ = 0;
  std::unique_ptr<hal::JpegDecoder> decoder_ = std::make_unique<hal::JpegDecoder>();
  std::vector<std::byte> pixels_;
};

}  // namespace orbwatch::app::recorder
