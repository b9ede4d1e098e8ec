// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/ros/ros_node.h"

#include <algorithm>
#include <vector>

#include "app/ports/dds/generated/participant_entities.h"
#include "app/ports/dds/ros/type_hash.h"

namespace orbwatch::app::dds {
namespace {

using Iron = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
using Humble = rmw_dds_common_msg_humble__ParticipantEntitiesInfo_;
constexpr const dds_topic_descriptor_t& kIron =
    rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;

/// Descriptor of a generation; the two wire formats have the same type name.
const dds_topic_descriptor_t& descriptor(RosGeneration generation) {
  static const dds_topic_descriptor_t humble = [] {
    dds_topic_descriptor_t type = rmw_dds_common_msg_humble__ParticipantEntitiesInfo__desc;
    type.m_typename = kIron.m_typename;
    return type;
  }();
  return generation == RosGeneration::Humble ? humble : kIron;
}

/// The GUID's bytes in wire order, then zeros, as in rmw_cyclonedds and rmw_fastrtps.
template <class Gid>
Result<> fill(Gid& gid, dds_entity_t entity) {
  dds_guid_t guid{};
  const dds_return_t code = dds_get_guid(entity, &guid);
  if (code < 0) return tl::unexpected(dds_error("GUID of an endpoint of the ROS node", code));
  static_assert(sizeof gid.data >= sizeof guid.v);
  std::ranges::fill(gid.data, 0);
  std::ranges::copy(guid.v, gid.data);
  return {};
}

template <class Gid>
Result<std::vector<Gid>> gids(std::span<const dds_entity_t> entities) {
  std::vector<Gid> list(entities.size());
  for (std::size_t i = 0; i < entities.size(); ++i) {
    if (const auto filled = fill(list[i], entities[i]); !filled) {
      return tl::unexpected(filled.error());
    }
  }
  return list;
}

/// The sequence refers to the list, which outlives it.
template <class Sequence, class Entry>
void refer(Sequence& sequence, std::vector<Entry>& list) {
  const auto size = static_cast<std::uint32_t>(list.size());
  sequence = {size, size, list.data(), false};
}

template <std::size_t size>
void copy(std::string_view text, char (&place)[size]) {
  text.copy(place, size - 1);  // the rest stays zero
}

template <class Info>
Result<> write(const Entity& writer, dds_entity_t participant,
               std::span<const dds_entity_t> writers, std::span<const dds_entity_t> readers) {
  using Gid = decltype(Info::gid);
  using Node = std::remove_pointer_t<decltype(Info{}.node_entities_info_seq._buffer)>;
  auto writer_gids = gids<Gid>(writers);
  if (!writer_gids) return tl::unexpected(writer_gids.error());
  auto reader_gids = gids<Gid>(readers);
  if (!reader_gids) return tl::unexpected(reader_gids.error());
  Info info{};
  if (const auto filled = fill(info.gid, participant); !filled) return filled;
  std::vector<Node> nodes(1);
  copy(kNodeNamespace, nodes[0].node_namespace);
  copy(kNodeName, nodes[0].node_name);
  refer(nodes[0].writer_gid_seq, *writer_gids);
  refer(nodes[0].reader_gid_seq, *reader_gids);
  refer(info.node_entities_info_seq, nodes);
  const dds_return_t code = dds_write(writer.get(), &info);
  if (code < 0) return tl::unexpected(dds_error("write of ros_discovery_info", code));
  return {};
}

}  // namespace

Result<> DiscoveryInfo::open(const Entity& participant, RosGeneration generation) {
  const dds_topic_descriptor_t& type = descriptor(generation);
  const Qos qos = state_qos();
  if (generation == RosGeneration::Iron) {  // ROS 2 never published a hash of the other format
    if (const auto announced = announce_type_hash(qos, type); !announced) return announced;
  }
  auto topic = make_topic(participant, type, kTopic);
  if (!topic) return tl::unexpected(topic.error());
  auto writer = make_writer(participant, *topic, qos);
  if (!writer) return tl::unexpected(writer.error());
  close();
  generation_ = generation;
  participant_ = participant.get();
  topic_ = std::move(*topic);
  writer_ = std::move(*writer);
  return {};
}

void DiscoveryInfo::close() {
  writer_.reset();
  topic_.reset();
}

Result<> DiscoveryInfo::announce(std::span<const dds_entity_t> writers,
                                 std::span<const dds_entity_t> readers) {
  if (!writer_)
    return fail("ros_discovery_info is not open: open it before endpoints are announced");
  return generation_ == RosGeneration::Humble
             ? write<Humble>(writer_, participant_, writers, readers)
             : write<Iron>(writer_, participant_, writers, readers);
}

}  // namespace orbwatch::app::dds
