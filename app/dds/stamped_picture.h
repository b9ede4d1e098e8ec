#pragma once

#include <memory>
#include <string>

#include "app/dds/time_message.h"
#include "proc/image/picture.h"

namespace orbwatch::app {

/// A picture on its way from the pipeline to topics.
struct StampedPicture {
  std::shared_ptr<const void> owner;  ///< of the pixels: a view or a camera's frame
  Picture picture;
  TimeMessage stamp{};                    ///< UTC of the exposure's start
  const std::string* frame_id = nullptr;  ///< outlives the topics
};

}  // namespace orbwatch::app
