// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/sink/published.h"
#include "app/ports/dds/dds_settings.h"
#include "app/ports/dds/pictures/info_topic.h"
#include "app/ports/dds/pictures/picture_topic.h"
#include "hal/frame/buffer_count.h"
#include "hal/frame/frame.h"

namespace orbwatch::app::dds {

/// Topics of a camera's own picture of the ball, and of its calibration if the lens is known.
/// Thread rule: as ViewTopics.
class CameraTopics {
 public:
  CameraTopics(const DdsSettings& settings, const std::string& name, const PublishedCamera& camera,
               const std::shared_ptr<hal::SharedThreads>& threads);

  Result<> open(const Entity& participant);
  void close();

  /// Queues the picture for topics with readers; returns at once. `stamp` is that of the frame's
  /// own exposure.
  void accept(const hal::Frame& frame, const TimeMessage& stamp);
  /// Writes the calibration of the newest picture, if it has a reader.
  void publish_info();

  std::chrono::nanoseconds cpu_time() const { return ball_.cpu_time(); }
  std::vector<const TopicWriter*> writers() const;
  void report(std::vector<TopicStatistics>& topics) const;

 private:
  static_assert(PictureTopics::kTopics <= hal::kFrameReaders);

  const std::string name_;
  const PublishedCamera camera_;
  PictureTopics ball_;
  std::optional<InfoTopic> info_;
};

}  // namespace orbwatch::app::dds
