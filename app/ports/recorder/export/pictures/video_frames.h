// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/pictures/caption.h"
#include "app/pictures/jpeg_encoder.h"
#include "app/ports/recorder/events/trigger_picture.h"
#include "app/ports/recorder/export/export_steps.h"
#include "app/ports/recorder/export/pictures/camera_pictures.h"
#include "app/ports/recorder/export/pictures/camera_video.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// The pictures of a camera as JPEG of one size, one after another. Thread-bound.
class VideoFrames {
 public:
  /// Reads all pictures if brightness or text depend on them. `pictures` is the caller's and
  /// outlives this. Errors: those of `pictures`; different sizes; cancelled.
  static Result<VideoFrames> make(CameraPictures& pictures, VideoText text,
                                  const ExportSteps& steps);

  int width() const;
  int height() const;

  /// The next picture, valid until the next call. Errors: those of `pictures`.
  Result<std::span<const std::byte>> next();

 private:
  explicit VideoFrames(CameraPictures& pictures) : pictures_(&pictures) {}

  Result<> survey(bool has_text, const ExportSteps& steps);
  Picture in_8_bit(const Picture& picture);
  Picture with_text(const Picture& picture, const ExportedPicture& exported);

  CameraPictures* pictures_;
  GreyRange grey_;                  ///< of all pictures with more than 8 bit
  std::optional<Caption> caption_;  ///< none: no text
  std::vector<std::uint8_t> converted_, canvas_;
  JpegEncoder encoder_;
};

}  // namespace orbwatch::app::recorder
