// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/fleet/thumbnail_writer.h"

namespace orbwatch::app::dds {

void ThumbnailWriter::write(StampedPicture stamped, TopicWriter& topic) {
  const Picture small = thumbnail_.of(stamped.picture);
  stamped.owner.reset();
  const auto jpeg = encoder_.encode(small, quality_);
  if (!jpeg) {
    topic.count_failure(jpeg.error().message);
    return;
  }
  const auto length = static_cast<std::uint32_t>(jpeg->size());
  const orbwatch_msgs_msg_dds__Thumbnail_ message{{length, length, jpeg->data(), false}};
  topic.write(&message);
}

}  // namespace orbwatch::app::dds
