// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hal/camera.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "hal/mcap/chunk_loader.h"
#include "hal/recording/camera_channels.h"
#include "hal/recording/messages.h"
#include "hal/recording/picture_region.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// The stored part of a picture, whose pixels or JPEG lie in the message.
struct RecordedPart {
  Header header;
  PixelFormat format{};
  int width = 0, height = 0;
  std::optional<Picture> pixels;    ///< absent: the part is JPEG
  std::span<const std::byte> jpeg;  ///< JPEG data; empty if `pixels` is set
};

/// Format of a camera's pictures by the first one and the channel's metadata, without the sides.
/// JPEG is decoded to Grey, Nv12 or Rgb. Errors: damaged; an unknown encoding; wrong metadata.
Result<StreamFormat> first_format(const mcap::Message& message, const CameraChannels& channels);

/// The part in a message of any origin. `format`: that of first_format(). Errors: damaged; what
/// picture_of() refuses. Reentrant.
Result<RecordedPart> part_in(const mcap::Message& message, const CameraChannels& channels,
                             PixelFormat format);

/// Writes the part to its place, for which check_fit() has passed. Returns Flawed for JPEG that
/// JpegDecoder calls so. Error: damaged JPEG.
Result<FrameStatus> place_part(const RecordedPart& part, const PictureRegion& region,
                               JpegDecoder& decoder, const MutablePicture& whole);

/// Pixels of the part alone in `buffer`, without padding: the whole picture of a recording of any
/// origin may be larger than the memory. Errors: damaged JPEG; more than mcap::Limits::chunk.
Result<Picture> pixels_of(const RecordedPart& part, const ColourSpace& colour_space,
                          JpegDecoder& decoder, std::vector<std::byte>& buffer);

}  // namespace orbwatch::hal::recording
