// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/pictures/thumbnail.h"
#include "app/ports/dds/generated/appliance.h"
#include "app/ports/dds/pictures/picture_writer.h"

namespace orbwatch::app::dds {

/// orbwatch_msgs/Thumbnail: a small JPEG.
class ThumbnailWriter final : public PictureWriter {
 public:
  const dds_topic_descriptor_t& type() const override {
    return orbwatch_msgs_msg_dds__Thumbnail__desc;
  }
  void write(StampedPicture picture, TopicWriter& topic) override;

 private:
  /// Quality that keeps thumbnails small enough for any network.
  JpegQuality quality_{{.quality = 75, .target_bytes = 6000}};
  Thumbnail thumbnail_;
  JpegEncoder encoder_;
};

}  // namespace orbwatch::app::dds
