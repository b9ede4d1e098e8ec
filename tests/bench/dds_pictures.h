// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/ports/dds/fastdds/pace.h"

namespace orbwatch::bench {

/// Pictures passed to the sink and their form as a topic.
enum class Pictures {
  View,       ///< 1080p, rgb8, not converted
  SmallView,  ///< 400x250, the size of a JPEG picture
  Camera,     ///< 1080p NV12, converted to mono8
  Jpeg,       ///< a 1080p view, compressed to about 300 kB
};

app::DdsSettings settings_for(Pictures pictures);

/// Offered to the sink's readers in the encoding that such pictures go out in.
std::vector<app::PublishedCamera> cameras_for(Pictures pictures);

/// The topic of sensor_msgs/Image, or of CompressedImage.
std::string topic_of(Pictures pictures);

/// Source that passes such pictures to the sink.
std::unique_ptr<app::tests::Pace> paced(Pictures pictures, app::Sink& sink);

}  // namespace orbwatch::bench
