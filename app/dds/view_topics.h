#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/dds/dds_settings.h"
#include "app/dds/picture_topics.h"
#include "app/pipeline/view.h"
#include "hal/mailbox.h"

namespace orbwatch::app {

/// The topics of one view: what people look at, what is measured, and the calibration of a
/// perspective one.
/// Thread rule: accept by one thread; publish_info, open and close by one owner; report by any.
class ViewTopics {
 public:
  ViewTopics(const DdsSettings& settings, const std::string& view);

  Result<> open(const Entity& participant);
  void close();

  /// Takes what somebody reads; returns at once. `picture` is the view as it is looked at.
  void accept(const ViewPtr& view, const StampedPicture& picture);
  /// Writes the calibration of the newest view, if somebody reads it.
  void publish_info();

  const std::string& name() const { return name_; }
  std::vector<const TopicWriter*> writers() const;
  void report(std::vector<TopicStatistics>& topics) const;

 private:
  struct StampedSpec {
    optics::ViewSpec spec;
    TimeMessage stamp;
  };

  std::string name_;
  PictureTopics looked_at_;
  std::optional<PictureTopic> measured_;
  std::optional<TopicWriter> info_;
  hal::Mailbox<StampedSpec> spec_;
};

}  // namespace orbwatch::app
