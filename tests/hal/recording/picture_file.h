// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "hal/mcap/cdr.h"
#include "hal/mcap/writer.h"
#include "hal/recording/camera_stream.h"
#include "hal/recording/image.h"
#include "hal/recording/picture_region.h"
#include "hal/recording/topics.h"

namespace orbwatch::tests {

template <class T>
T required(tl::expected<T, hal::mcap::FileError> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}
inline void required(const tl::expected<void, hal::mcap::FileError>& result) {
  if (!result) throw std::runtime_error(result.error().message);
}

/// Writes a recording of pictures. Errors are thrown.
class PictureFile {
 public:
  explicit PictureFile(const std::filesystem::path& path)
      : writer_(required(hal::mcap::Writer::create(path))) {}

  /// Channel of the topic.
  std::uint16_t add(const std::string& topic, std::string_view type,
                    const hal::mcap::StringMap& metadata = {}) {
    const auto schema =
        required(writer_.add_schema({0, std::string(type), "ros2msg", "# of a test\n"}));
    return required(writer_.add_channel({0, schema, topic, "cdr", metadata}));
  }

  void add(const hal::mcap::Metadata& metadata) { required(writer_.add_metadata(metadata)); }

  template <class Message>
  void write(std::uint16_t channel, std::uint64_t log_time, std::uint32_t sequence,
             const Message& message) {
    write(channel, log_time, sequence, message, log_time);
  }
  template <class Message>
  void write(std::uint16_t channel, std::uint64_t log_time, std::uint32_t sequence,
             const Message& message, std::uint64_t publish_time) {
    hal::mcap::encode_cdr(message, bytes_);
    required(writer_.write({channel, sequence, log_time, publish_time}, bytes_));
  }

  void flush() { required(writer_.flush()); }
  void attach(const std::string& name, std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    required(writer_.attach({0, 0, name, "application/toml", {bytes.begin(), bytes.end()}}));
  }
  void finish() { required(writer_.finish()); }

 private:
  hal::mcap::Writer writer_;
  hal::mcap::Bytes bytes_;
};

/// Channels of one camera in a PictureFile.
class CameraTopics {
 public:
  CameraTopics(PictureFile& file, std::string camera, const hal::StreamFormat& format)
      : file_(file),
        camera_(std::move(camera)),
        pictures_(file.add(hal::recording::image_topic("orbwatch", camera_),
                           hal::recording::Image::kType, hal::recording::metadata_of(format))),
        info_(file.add(hal::recording::camera_info_topic("orbwatch", camera_),
                       hal::recording::CameraInfo::kType)) {}

  /// Writes the region of a picture that was exposed at `start`; its set has the stamp `set_time`.
  void write(const Picture& picture, const hal::recording::PictureRegion& region,
             std::uint64_t set_time, std::uint64_t start, std::uint32_t sequence) {
    using namespace hal::recording;
    const Header header = header_at(start, camera_);
    file_.write(info_, set_time, sequence,
                camera_info_of({picture.width, picture.height, region}, header));
    file_.write(pictures_, set_time, sequence, image_of(part_of(picture, region), header, pixels_));
  }

 private:
  PictureFile& file_;
  std::string camera_;
  std::uint16_t pictures_, info_;
  hal::mcap::Bytes pixels_;
};

}  // namespace orbwatch::tests
