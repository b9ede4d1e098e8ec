// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/fleet/fleet_reader.h"

#include <memory>
#include <string>
#include <utility>

#include "app/ports/dds/fleet/appliance_message.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {
namespace {

/// Depth of the readers' histories; samples are taken as they arrive, so it exceeds any burst.
constexpr std::int32_t kDepth = 64;

std::string text_of(const dds_guid_t& guid) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : guid.v) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

/// Id of the participant that wrote a sample; empty: it has left already.
std::string writer_of(dds_entity_t reader, const dds_sample_info_t& info) {
  const std::unique_ptr<dds_builtintopic_endpoint_t, void (*)(dds_builtintopic_endpoint_t*)> writer(
      dds_get_matched_publication_data(reader, info.publication_handle),
      dds_builtintopic_free_endpoint);
  return writer ? text_of(writer->participant_key) : std::string();
}

/// Calls `accept(id, message)` with each available sample; counts those for which it returns false
/// as refused.
template <class Message, class Accept>
void take_all(dds_entity_t reader, Fleet& fleet, const Accept& accept) {
  const auto take = [&](const void* sample, const dds_sample_info_t& info) {
    const std::string id = writer_of(reader, info);
    if (!id.empty() && !accept(id, *static_cast<const Message*>(sample))) fleet.refuse();
  };
  take_all_samples(reader, take);
  show_order_of_calls();
}

/// Best effort: each notice is repeated after a second, so acknowledgements between all appliances
/// are not worthwhile.
Qos notice_qos() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kDepth);
  return qos;
}

Qos thumbnail_qos() {
  Qos qos = frame_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kDepth);
  return qos;
}

}  // namespace

FleetReader::FleetReader(Fleet& fleet)
    : fleet_(fleet),
      notices_(orbwatch_msgs_msg_dds__Appliance__desc, std::string(kApplianceTopic)),
      thumbnails_(orbwatch_msgs_msg_dds__Thumbnail__desc, std::string(kThumbnailTopic)) {}

Result<> FleetReader::open(const Entity& participant) {
  show_order_of_calls();
  const Listener listener(dds_create_listener(this));
  dds_lset_data_available(listener.get(), on_notices);
  return notices_.open(participant, notice_qos(), listener.get());
}

void FleetReader::close() {
  notices_.close();
  thumbnails_.close();
  show_order_of_calls();
}

Result<> FleetReader::read_thumbnails(const Entity& participant, bool wanted) {
  const bool reads = thumbnails_.get() > 0;
  if (wanted == reads) return {};
  show_order_of_calls();
  if (!wanted) {
    thumbnails_.close();
    return {};
  }
  const Listener listener(dds_create_listener(this));
  dds_lset_data_available(listener.get(), on_thumbnails);
  return thumbnails_.open(participant, thumbnail_qos(), listener.get());
}

void FleetReader::on_notices(dds_entity_t reader, void* self) {
  show_order_of_calls();
  Fleet& fleet = static_cast<FleetReader*>(self)->fleet_;
  take_all<ApplianceMessage>(reader, fleet, [&](const std::string& id, const auto& message) {
    const auto notice = check_appliance(message);
    if (notice) fleet.receive(id, *notice, hal::Clock::now());
    return notice.has_value();
  });
}

void FleetReader::on_thumbnails(dds_entity_t reader, void* self) {
  show_order_of_calls();
  Fleet& fleet = static_cast<FleetReader*>(self)->fleet_;
  take_all<ThumbnailMessage>(reader, fleet, [&](const std::string& id, const auto& message) {
    if (!check_thumbnail(message)) return false;
    const auto* const bytes = reinterpret_cast<const char*>(message.jpeg._buffer);
    fleet.show(id, std::string(bytes, message.jpeg._length));
    return true;
  });
}

Result<std::string> appliance_id(dds_entity_t participant) {
  dds_guid_t guid{};
  const dds_return_t code = dds_get_guid(participant, &guid);
  if (code < 0) return tl::unexpected(dds_error("GUID of the participant", code));
  return text_of(guid);
}

}  // namespace orbwatch::app::dds
