// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hal/recording/camera_recording.h"
#include "hal/replay/picture_decoder.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Pictures of one camera on a disk, for tools that compute at their own pace: a folder of JPEG and
/// PNG pictures in natural order of their names, a single picture, or an MCAP recording, which has
/// the ball's part of the camera's pictures; the rest is black. Thread-bound.
class PictureSequence {
 public:
  /// `camera`: the one of a recording; a folder is of one. Errors: those of pictures_in() and
  /// CameraRecording::open().
  static Result<PictureSequence> open(const std::filesystem::path& source, std::string_view camera);

  /// Number of pictures, at least one.
  std::size_t size() const;
  /// Name of a picture in messages: its file, or its number in the recording.
  std::string name(std::size_t picture) const;
  /// The same with the path.
  std::string path(std::size_t picture) const;
  /// Time since the first picture; nullopt: not known.
  std::optional<std::chrono::nanoseconds> time(std::size_t picture) const;
  /// Stamp of its frame set: pictures of one recording that have the same are of one moment.
  /// nullopt: not known.
  std::optional<std::uint64_t> set_time(std::size_t picture) const;

  /// Decodes a picture; quickest in rising order. Errors, with the picture: it cannot be decoded.
  Result<DecodedPicture> read(std::size_t picture);

 private:
  using Files = std::vector<std::filesystem::path>;
  using Source = std::variant<Files, recording::CameraRecording>;

  PictureSequence(std::filesystem::path path, Source source)
      : path_(std::move(path)), source_(std::move(source)) {}

  std::filesystem::path path_;
  Source source_;
};

}  // namespace orbwatch::hal
