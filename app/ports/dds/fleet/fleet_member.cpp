// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/fleet/fleet_member.h"

#include <utility>

#include "app/log.h"
#include "app/ports/dds/fleet/appliance_message.h"
#include "app/ports/dds/fleet/thumbnail_writer.h"
#include "app/ports/dds/topics/topic_names.h"
#include "hal/host.h"

namespace orbwatch::app::dds {
namespace {

constexpr auto kPeriod = std::chrono::seconds(1);
/// Rate of thumbnails.
constexpr double kPicturesPerSecond = 0.25;

ApplianceIdentity named(ApplianceIdentity identity) {
  if (identity.name.empty()) identity.name = hal::host_name();
  return identity;
}

}  // namespace

FleetMember::FleetMember(ApplianceIdentity identity, std::shared_ptr<Fleet> fleet,
                         const std::shared_ptr<hal::SharedThreads>& threads)
    : identity_(named(std::move(identity))),
      fleet_(std::move(fleet)),
      notices_(orbwatch_msgs_msg_dds__Appliance__desc, std::string(kApplianceTopic)),
      thumbnails_(std::string(kThumbnailTopic), std::make_unique<ThumbnailWriter>(), threads,
                  kPicturesPerSecond) {
  if (fleet_) reader_.emplace(*fleet_);
}

void FleetMember::open(const Entity& participant, const std::string& address) {
  present_ = identity_;
  if (hal::is_unspecified(present_.page.address)) present_.page.address = address;
  const auto opened = open_all(participant);
  is_open_ = opened.has_value();
  if (is_open_) return;
  close();
  const char* const remedy =
      is_refused_by_security(opened.error())
          ? ". Keys of an earlier version do not permit it: `orbwatch dds-keys` makes new ones"
          : "";
  log_line(LogLevel::Warning, opened.error().message +
                                  "; this appliance neither shows nor appears in the fleet list" +
                                  remedy);
}

Result<> FleetMember::open_all(const Entity& participant) {
  participant_ = &participant;
  return notices_.open(participant, state_qos())
      .and_then([&] { return thumbnails_.open(participant); })
      .and_then([&] { return reader_ ? reader_->open(participant) : Result<>(); })
      .and_then([&] { return appliance_id(participant.get()); })
      .map([&](const std::string& id) {
        if (fleet_) fleet_->set_own_id(id);
      });
}

void FleetMember::close() {
  is_open_ = false;
  if (reader_) reader_->close();
  thumbnails_.close();
  notices_.close();
}

void FleetMember::publish(const StatusReport& report) {
  if (!is_open_ || report.now < next_) return;
  next_ = report.now + kPeriod;
  const ApplianceMessage message = appliance_message(notice_of(present_, report));
  notices_.write(&message);
  if (!reader_) return;
  const auto read = reader_->read_thumbnails(*participant_, fleet_->has_viewers(report.now));
  if (!read) log_line(LogLevel::Warning, read.error().message);
}

PictureNeeds FleetMember::needs(const TimeMessage& stamp) {
  asked_ = thumbnails_.wants(stamp);
  PictureNeeds needs;
  needs.jpeg = asked_;
  return needs;
}

std::vector<const TopicWriter*> FleetMember::writers() const {
  if (!is_open_) return {};
  return {&notices_, &thumbnails_.writer()};
}

void FleetMember::report(std::vector<TopicStatistics>& topics) const {
  topics.push_back(notices_.statistics());
  topics.push_back(thumbnails_.statistics());
}

}  // namespace orbwatch::app::dds
