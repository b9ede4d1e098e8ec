// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/pictures/view_topics.h"

#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {

ViewTopics::ViewTopics(const DdsSettings& settings, const std::string& name,
                       const PublishedView& view,
                       const std::shared_ptr<hal::SharedThreads>& threads)
    : name_(name),
      picture_(image_topic(settings.prefix, name), view.encoding, settings.jpeg, threads) {
  const bool is_perspective = view.spec.kind == optics::ViewKind::Perspective;
  if (is_perspective) info_.emplace(image_topic(settings.prefix, name));
  if (view.measured) {
    measured_.emplace(radiometric_topic(settings.prefix, name),
                      std::make_unique<RawPictureWriter>(PixelFormat::Grey), threads);
  }
  if (is_perspective && measured_) {
    measured_info_.emplace(radiometric_topic(settings.prefix, name));
  }
}

Result<> ViewTopics::open(const Entity& participant) {
  return picture_.open(participant)
      .and_then([&] { return measured_ ? measured_->open(participant) : Result<>(); })
      .and_then([&] { return info_ ? info_->open(participant) : Result<>(); })
      .and_then([&] { return measured_info_ ? measured_info_->open(participant) : Result<>(); });
}

void ViewTopics::close() {
  picture_.close();
  if (measured_) measured_->close();
  if (info_) info_->close();
  if (measured_info_) measured_info_->close();
}

bool ViewTopics::accept(const ViewPtr& view, const StampedPicture& picture, PictureTopics* same) {
  picture_.accept(picture, same);
  const StampedCalibration calibration{view->spec, picture.stamp, &name_};
  bool has_info = info_ && info_->accept(calibration);
  const bool narrow = view->radiometric.empty();
  if (measured_ && !(narrow && view->luminance.empty())) {
    measured_->accept({view,
                       narrow ? picture_of(PixelFormat::Grey, view->luminance)
                              : picture_of(PixelFormat::Y16, view->radiometric),
                       picture.stamp, &name_});
    if (measured_info_ && measured_info_->accept(calibration)) has_info = true;
  }
  return has_info;
}

void ViewTopics::publish_info() {
  if (info_) info_->publish();
  if (measured_info_) measured_info_->publish();
}

std::chrono::nanoseconds ViewTopics::cpu_time() const {
  return picture_.cpu_time() + (measured_ ? measured_->cpu_time() : std::chrono::nanoseconds(0));
}

std::vector<const TopicWriter*> ViewTopics::writers() const {
  std::vector<const TopicWriter*> writers = picture_.writers();
  if (measured_) writers.push_back(&measured_->writer());
  if (info_) writers.push_back(&info_->writer());
  if (measured_info_) writers.push_back(&measured_info_->writer());
  return writers;
}

void ViewTopics::report(std::vector<TopicStatistics>& topics) const {
  picture_.report(topics);
  if (measured_) topics.push_back(measured_->statistics());
  if (info_) topics.push_back(info_->statistics());
  if (measured_info_) topics.push_back(measured_info_->statistics());
}

}  // namespace orbwatch::app::dds
