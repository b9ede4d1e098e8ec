// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/dds/fastdds/reader.h"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <mutex>
#include <stdexcept>

namespace orbwatch::tests::fastdds {

namespace dds = eprosima::fastdds::dds;

namespace {

#ifdef FASTDDS_VERSION_MAJOR
constexpr auto kByNeed = eprosima::fastdds::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
using Duration = dds::Duration_t;
const auto kOk = dds::RETCODE_OK;
#else
constexpr auto kByNeed = eprosima::fastrtps::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
using Duration = eprosima::fastrtps::Duration_t;
const auto kOk = ReturnCode_t::RETCODE_OK;
#endif

dds::DataReaderQos qos_of(const ReaderSettings& settings) {
  dds::DataReaderQos qos;
  qos.reliability().kind =
      settings.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      settings.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = settings.depth;
  qos.endpoint().history_memory_policy = kByNeed;
  return qos;
}

}  // namespace

/// Records the first match; on a thread of Fast DDS.
class Reader::Listener final : public dds::DataReaderListener {
 public:
  void on_subscription_matched(dds::DataReader*,
                               const dds::SubscriptionMatchedStatus& status) override {
    const std::lock_guard lock(mutex_);
    if (status.current_count > 0 && !first_match_) first_match_ = Clock::now();
  }

  std::optional<Clock::time_point> first_match() const {
    const std::lock_guard lock(mutex_);
    return first_match_;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<Clock::time_point> first_match_;
};

Reader::Reader(Participant& participant, const ReaderSettings& settings)
    : listener_(std::make_unique<Listener>()) {
  dds::DomainParticipant& owner = participant.get();
  dds::TypeSupport type(new RawType(settings.type));
  type.register_type(&owner);
  dds::Topic* topic = owner.create_topic(settings.topic, settings.type, dds::TOPIC_QOS_DEFAULT);
  subscriber_ = owner.create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  if (topic != nullptr && subscriber_ != nullptr) {
    reader_ = subscriber_->create_datareader(topic, qos_of(settings), listener_.get(),
                                             dds::StatusMask::subscription_matched());
  }
  if (reader_ == nullptr) throw std::runtime_error("Fast DDS: no reader of " + settings.topic);
}

Reader::~Reader() { subscriber_->delete_datareader(reader_); }

std::optional<RawSample> Reader::take(std::chrono::milliseconds patience) {
  const Duration time(static_cast<long double>(patience.count()) / 1000);
  if (!reader_->wait_for_unread_message(time)) return {};
  RawSample sample;
  dds::SampleInfo info;
  if (reader_->take_next_sample(&sample, &info) != kOk || !info.valid_data) return {};
  return sample;
}

std::optional<Clock::time_point> Reader::first_match() const { return listener_->first_match(); }

}  // namespace orbwatch::tests::fastdds
