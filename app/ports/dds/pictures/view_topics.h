// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/model/sink/published.h"
#include "app/model/sink/view.h"
#include "app/ports/dds/dds_settings.h"
#include "app/ports/dds/pictures/info_topic.h"
#include "app/ports/dds/pictures/picture_topic.h"

namespace orbwatch::app::dds {

/// Topics of one view: its display picture and its measured plane, each with its calibration for a
/// perspective view. Thread rule: accept on one thread; publish_info, open and close by one owner;
/// report on any thread.
class ViewTopics {
 public:
  ViewTopics(const DdsSettings& settings, const std::string& name, const PublishedView& view,
             const std::shared_ptr<hal::SharedThreads>& threads);

  Result<> open(const Entity& participant);
  void close();

  /// The forms in which readers need the next display picture.
  PictureNeeds ask(const TimeMessage& stamp) { return picture_.ask(stamp); }
  /// Queues pictures for topics with readers; returns at once. `picture` is the view's display
  /// picture; `same`: see PictureTopics. Returns whether a calibration waits for publish_info().
  bool accept(const ViewPtr& view, const StampedPicture& picture, PictureTopics* same);
  /// Writes the calibrations of the newest pictures, if they have readers.
  void publish_info();

  std::chrono::nanoseconds cpu_time() const;
  const std::string& name() const { return name_; }
  std::vector<const TopicWriter*> writers() const;
  void report(std::vector<TopicStatistics>& topics) const;

 private:
  std::string name_;
  PictureTopics picture_;
  std::optional<PictureTopic> measured_;
  std::optional<InfoTopic> info_;
  std::optional<InfoTopic> measured_info_;
};

}  // namespace orbwatch::app::dds
