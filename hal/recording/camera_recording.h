// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "hal/jpeg/jpeg_decoder.h"
#include "hal/mcap/reader.h"
#include "hal/recording/camera_index.h"
#include "hal/recording/recorded_part.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// True for the file extension of recordings, ".mcap".
inline bool has_recording_name(const std::filesystem::path& path) {
  return path.extension() == ".mcap";
}

/// The pictures of one camera in a recording of any origin. Thread-bound.
class CameraRecording {
 public:
  /// Reads the whole file once. Errors, with the file: those of mcap::Reader and index_camera().
  static Result<CameraRecording> open(const std::filesystem::path& file, std::string_view camera);
  /// Opens a finished file whose index is known, without reading the whole. part() and read()
  /// refuse an exposure that it does not have any more. Errors, with the file: those of
  /// mcap::Reader::open_finished().
  static Result<CameraRecording> open(const std::filesystem::path& file,
                                      std::shared_ptr<const CameraIndex> index);

  const CameraIndex& index() const { return *index_; }

  /// The recorded part of an exposure, whose size is that of its region; its pixels or JPEG are
  /// valid until the next call. Quickest in rising order. Error: the disk.
  Result<RecordedPart> part(std::size_t exposure);

  /// Writes the whole picture of an exposure into `target`, of the index' format: its region, and
  /// black around it. Returns Flawed or Intact. Quickest in rising order. Errors: damaged JPEG;
  /// the disk.
  Result<FrameStatus> read(std::size_t exposure, const MutablePicture& target);

  /// The error of an exposure with its place.
  Error named(std::size_t exposure, const Error& error) const;

 private:
  CameraRecording(std::filesystem::path file, mcap::Reader reader,
                  std::shared_ptr<const CameraIndex> index)
      : file_(std::move(file)), reader_(std::move(reader)), index_(std::move(index)) {}

  Result<mcap::Message> load(const RecordedExposure& exposure);

  std::filesystem::path file_;
  mcap::Reader reader_;
  std::shared_ptr<const CameraIndex> index_;
  std::unique_ptr<JpegDecoder> jpeg_ = std::make_unique<JpegDecoder>();
  std::size_t chunk_ = static_cast<std::size_t>(-1);  ///< loaded chunk
  std::size_t next_ = 0;                              ///< its next message
};

}  // namespace orbwatch::hal::recording
