// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/dds/fastdds/participant.h"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <iomanip>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include "tests/app/ports/dds/fastdds/raw_type.h"
#ifdef FASTDDS_VERSION_MAJOR
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#endif

namespace orbwatch::tests::fastdds {

namespace dds = eprosima::fastdds::dds;

namespace {

template <class Guid>
std::string hexadecimal(const Guid& guid) {
  std::ostringstream out;
  out << std::hex << std::setfill('0');
  for (const auto byte : guid.guidPrefix.value) out << std::setw(2) << +byte;
  for (const auto byte : guid.entityId.value) out << std::setw(2) << +byte;
  return out.str();
}

}  // namespace

/// Records the announcements of writers; on threads of Fast DDS.
class Participant::Listener final : public dds::DomainParticipantListener {
 public:
#ifdef FASTDDS_VERSION_MAJOR
  using Status = eprosima::fastdds::rtps::WriterDiscoveryStatus;
  using Guid = eprosima::fastdds::rtps::GUID_t;

  void on_data_writer_discovery(dds::DomainParticipant*, Status status,
                                const dds::PublicationBuiltinTopicData& data,
                                bool& should_be_ignored) override {
    should_be_ignored = false;
    note(data.guid, status == Status::REMOVED_WRITER || status == Status::IGNORED_WRITER,
         {hexadecimal(data.guid), data.topic_name.to_string(), data.type_name.to_string(), {
            data.user_data.begin(),
            data.user_data.end()
          }});
  }
#else
  using Discovery = eprosima::fastrtps::rtps::WriterDiscoveryInfo;
  using Guid = eprosima::fastrtps::rtps::GUID_t;

  void on_publisher_discovery(dds::DomainParticipant*, Discovery&& discovery) override {
    const auto& data = discovery.info;
    const auto& user_data = data.m_qos.m_userData;
    note(data.guid(), discovery.status == Discovery::REMOVED_WRITER,
         {hexadecimal(data.guid()),
          data.topicName().to_string(),
          data.typeName().to_string(),
          {user_data.begin(), user_data.end()}});
  }
#endif

  std::vector<Announcement> announcements() const {
    const std::lock_guard lock(mutex_);
    std::vector<Announcement> all;
    all.reserve(writers_.size());
    for (const auto& [guid, announcement] : writers_) all.push_back(announcement);
    return all;
  }

 private:
  void note(const Guid& guid, bool removed, Announcement announcement) {
    const std::lock_guard lock(mutex_);
    if (removed) {
      writers_.erase(guid);
    } else {
      writers_[guid] = std::move(announcement);
    }
  }

  mutable std::mutex mutex_;
  std::map<Guid, Announcement> writers_;
};

Participant::Participant(const ParticipantSettings& settings)
    : listener_(std::make_unique<Listener>()) {
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->receiveBufferSize = settings.receive_buffer;
  dds::DomainParticipantQos qos;
  qos.name("fastdds_reader");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  qos.transport().listen_socket_buffer_size = settings.receive_buffer;
  participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(settings.domain), qos, listener_.get(), dds::StatusMask::none());
  if (participant_ == nullptr) throw std::runtime_error("Fast DDS: no participant");
}

Participant::~Participant() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

std::vector<Announcement> Participant::announcements() const { return listener_->announcements(); }

}  // namespace orbwatch::tests::fastdds
