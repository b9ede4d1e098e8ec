// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/jpeg_quality.h"
#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/pictures/image_message.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "proc/image/picture.h"

namespace orbwatch::app::dds {

/// A picture passed from the pipeline to topics.
struct StampedPicture {
  std::shared_ptr<const void> owner;  ///< owner of the pixels: a view or a camera's frame
  Picture picture;
  TimeMessage stamp{};                    ///< UTC of the exposure start
  const std::string* frame_id = nullptr;  ///< outlives the topics
  /// The picture is in one of a camera's few buffers: it is neither held until a previous write of
  /// the topic ends nor during its own write. It may wait for the write of another topic if all
  /// shared threads are busy.
  bool is_scarce = false;
  /// Second writer of the same sample, after the topic itself, which is closed before it; null:
  /// none.
  TopicWriter* also = nullptr;
};

/// Turns pictures into samples of a topic. Thread-bound; reuses its memory.
class PictureWriter {
 public:
  virtual ~PictureWriter() = default;
  virtual const dds_topic_descriptor_t& type() const = 0;
  /// Writes one sample, or counts a failure. A converted or scarce picture is released before the
  /// write, which may block.
  virtual void write(StampedPicture picture, TopicWriter& topic) = 0;
};

/// sensor_msgs/Image in one encoding; luminance of more than 8 bits is sent as mono16 regardless of
/// the encoding. Pixels of that encoding without padding are passed to DDS in place, unless they
/// are scarce.
class RawPictureWriter final : public PictureWriter {
 public:
  /// `encoding` is Rgb, Bgr or Grey.
  explicit RawPictureWriter(PixelFormat encoding) : encoding_(encoding) {}

  const dds_topic_descriptor_t& type() const override { return sensor_msgs_msg_dds__Image__desc; }
  void write(StampedPicture picture, TopicWriter& topic) override;

 private:
  PixelFormat encoding_;
  std::vector<std::byte> converted_;
};

/// sensor_msgs/CompressedImage as JPEG.
class JpegPictureWriter final : public PictureWriter {
 public:
  explicit JpegPictureWriter(const JpegSettings& settings) : quality_(settings) {}

  const dds_topic_descriptor_t& type() const override {
    return sensor_msgs_msg_dds__CompressedImage__desc;
  }
  void write(StampedPicture picture, TopicWriter& topic) override;

 private:
  JpegQuality quality_;
  JpegEncoder encoder_;
};

}  // namespace orbwatch::app::dds
