#pragma once

#include <string>
#include <variant>

#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "hal/thread/mailbox.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// A picture's calibration on its way from the pipeline to a topic.
struct StampedCalibration {
  std::variant<optics::ViewSpec, optics::Intrinsics>
      calibration;                        ///< of a perspective view, or lens
  TimeMessage stamp{};                    ///< of the picture
  const std::string* frame_id = nullptr;  ///< of the picture; outlives the topic
};

/// The camera_info beside an image topic: the calibration of each picture, with its stamp and
/// frame_id. The newest wins. Without a reader it costs nothing.
/// Thread rule: accept by one thread; publish, open and close by one owner; the rest by any.
class InfoTopic {
 public:
  /// `raw` is the name of the image topic.
  explicit InfoTopic(const std::string& raw);

  Result<> open(const Entity& participant);
  void close();

  /// Queues the calibration of a picture if it has a reader; returns at once.
  void accept(const StampedCalibration& picture);
  /// Writes the newest, if there is one.
  void publish();

  const TopicWriter& writer() const { return topic_; }
  TopicStatistics statistics() const;

 private:
  TopicWriter topic_;
  hal::Mailbox<StampedCalibration> newest_;
};

}  // namespace orbwatch::app
