// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>

#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "hal/thread/mailbox.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::dds {

/// Calibration of a picture, passed from the pipeline to a topic.
struct StampedCalibration {
  std::variant<optics::ViewSpec, optics::Intrinsics> calibration;  ///< perspective view, or lens
  TimeMessage stamp{};                                             ///< stamp of the picture
  const std::string* frame_id = nullptr;  ///< the picture's frame_id; outlives the topic
};

/// The camera_info beside an image topic: the calibration of each picture, with its stamp and
/// frame_id. The newest wins. A topic without a reader has no cost.
/// Thread rule: accept on one thread; publish, open and close by one owner; everything else on any
/// thread.
class InfoTopic {
 public:
  /// `raw` is the name of the image topic.
  explicit InfoTopic(const std::string& raw);

  Result<> open(const Entity& participant);
  void close();

  /// Queues the calibration of a picture if it has a reader; returns at once, true if it did.
  bool accept(const StampedCalibration& picture);
  /// Writes the newest calibration, if there is one.
  void publish();

  const TopicWriter& writer() const { return topic_; }
  TopicStatistics statistics() const;

 private:
  TopicWriter topic_;
  hal::Mailbox<StampedCalibration> newest_;
};

}  // namespace orbwatch::app::dds
