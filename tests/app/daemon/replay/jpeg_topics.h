// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "app/pictures/jpeg_encoder.h"
#include "tests/hal/recording/picture_file.h"

namespace orbwatch::tests {

/// Channels of one camera in a PictureFile, whose pictures are coded as the recorder does.
class JpegTopics {
 public:
  JpegTopics(PictureFile& file, std::string camera, const hal::StreamFormat& format, int quality)
      : file_(file),
        camera_(std::move(camera)),
        quality_(quality),
        pictures_(file.add(hal::recording::compressed_topic("orbwatch", camera_),
                           hal::recording::CompressedImage::kType, metadata_of(format, quality))),
        info_(file.add(hal::recording::camera_info_topic("orbwatch", camera_),
                       hal::recording::CameraInfo::kType)) {}

  /// The same as CameraTopics::write(), but as JPEG.
  void write(const Picture& picture, const hal::recording::PictureRegion& region,
             std::uint64_t set_time, std::uint64_t start, std::uint32_t sequence) {
    using namespace hal::recording;
    const Header header = header_at(start, camera_);
    file_.write(info_, set_time, sequence,
                camera_info_of({picture.width, picture.height, region}, header));
    const auto jpeg = encoder_.encode(part_of(picture, region), quality_);
    CompressedImage message;
    message.header = header;
    message.format = kColourJpeg;
    message.data = std::as_bytes(jpeg.value());
    file_.write(pictures_, set_time, sequence, message);
  }

 private:
  static hal::mcap::StringMap metadata_of(const hal::StreamFormat& format, int quality) {
    auto metadata = hal::recording::metadata_of(format);
    metadata.emplace_back(hal::recording::kJpegQuality, std::to_string(quality));
    return metadata;
  }

  PictureFile& file_;
  std::string camera_;
  int quality_;
  std::uint16_t pictures_, info_;
  app::JpegEncoder encoder_;
};

}  // namespace orbwatch::tests
