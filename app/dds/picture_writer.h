#pragma once

#include <cstddef>
#include <vector>

#include "app/dds/image_message.h"
#include "app/dds/stamped_picture.h"
#include "app/dds/topic_writer.h"
#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/jpeg_quality.h"

namespace orbwatch::app {

/// How a picture becomes a sample of a topic. Thread-bound; memory is kept from one to the next.
class PictureWriter {
 public:
  virtual ~PictureWriter() = default;
  virtual const dds_topic_descriptor_t& type() const = 0;
  /// Writes one sample, or counts a failure. What was converted is let go of before it is written,
  /// since that can take as long as the network likes and cameras have few buffers.
  virtual void write(StampedPicture picture, TopicWriter& topic) = 0;
};

/// sensor_msgs/Image in one encoding; luminance of more than 8 bit goes as mono16 whatever the
/// encoding. Pixels that are so already, without padding, are handed to DDS in place.
class RawPictureWriter final : public PictureWriter {
 public:
  /// `encoding` is Rgb, Bgr or Grey.
  explicit RawPictureWriter(PixelFormat encoding) : encoding_(encoding) {}

  const dds_topic_descriptor_t& type() const override;
  void write(StampedPicture picture, TopicWriter& topic) override;

 private:
  PixelFormat encoding_;
  std::vector<std::byte> converted_;
};

/// sensor_msgs/CompressedImage as JPEG.
class JpegPictureWriter final : public PictureWriter {
 public:
  explicit JpegPictureWriter(const JpegSettings& settings) : quality_(settings) {}

  const dds_topic_descriptor_t& type() const override;
  void write(StampedPicture picture, TopicWriter& topic) override;

 private:
  JpegQuality quality_;
  JpegEncoder encoder_;
};

}  // namespace orbwatch::app
