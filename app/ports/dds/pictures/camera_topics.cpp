// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/pictures/camera_topics.h"

#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {

CameraTopics::CameraTopics(const DdsSettings& settings, const std::string& name,
                           const PublishedCamera& camera,
                           const std::shared_ptr<hal::SharedThreads>& threads)
    : name_(name),
      camera_(camera),
      ball_(ball_topic(settings.prefix, name), camera.encoding, settings.jpeg, threads) {
  if (camera_.lens) info_.emplace(ball_topic(settings.prefix, name));
}

Result<> CameraTopics::open(const Entity& participant) {
  return ball_.open(participant).and_then([&] {
    return info_ ? info_->open(participant) : Result<>();
  });
}

void CameraTopics::close() {
  ball_.close();
  if (info_) info_->close();
}

void CameraTopics::accept(const hal::Frame& frame, const TimeMessage& stamp) {
  ball_.ask(stamp);
  ball_.accept({frame, frame->picture, stamp, &name_, true});
  if (info_) info_->accept({*camera_.lens, stamp, &name_});
}

void CameraTopics::publish_info() {
  if (info_) info_->publish();
}

std::vector<const TopicWriter*> CameraTopics::writers() const {
  std::vector<const TopicWriter*> writers = ball_.writers();
  if (info_) writers.push_back(&info_->writer());
  return writers;
}

void CameraTopics::report(std::vector<TopicStatistics>& topics) const {
  ball_.report(topics);
  if (info_) topics.push_back(info_->statistics());
}

}  // namespace orbwatch::app::dds
