// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/ros/ros_node.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "app/ports/dds/generated/image.h"
#include "app/ports/dds/generated/participant_entities.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/topic_reader.h"
#include "tests/app/ports/dds/wire.h"

namespace orbwatch::app::dds {
namespace {

using tests::Bytes;
using tests::Cdr;
using tests::eventually;

constexpr const char* kType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

/// The generated type under the name that both generations give it.
dds_topic_descriptor_t type_of(RosGeneration generation) {
  dds_topic_descriptor_t type = generation == RosGeneration::Humble
                                    ? rmw_dds_common_msg_humble__ParticipantEntitiesInfo__desc
                                    : rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;
  type.m_typename = kType;
  return type;
}

class DiscoveryInfoTest : public testing::TestWithParam<RosGeneration> {
 protected:
  using Reader = tests::TopicReader<rmw_dds_common_msg_dds__ParticipantEntitiesInfo_>;

  void SetUp() override { ASSERT_TRUE(network_.valid()); }

  std::size_t gid_size() const { return GetParam() == RosGeneration::Humble ? 24 : 16; }

  /// A Gid: the 16 bytes of the entity's GUID in DDS, then zeros.
  Bytes gid(dds_entity_t entity) const {
    dds_guid_t guid{};
    EXPECT_EQ(dds_get_guid(entity, &guid), DDS_RETCODE_OK);
    Bytes bytes(std::begin(guid.v), std::end(guid.v));
    bytes.resize(gid_size());
    return bytes;
  }
  void put(Cdr& cdr, dds_entity_t entity) const {
    for (const std::uint8_t byte : gid(entity)) cdr.number(byte);
  }
  void put(Cdr& cdr, const std::vector<dds_entity_t>& entities) const {
    cdr.number(static_cast<std::uint32_t>(entities.size()));
    for (const dds_entity_t entity : entities) put(cdr, entity);
  }
  /// Order by rmw_dds_common's definition: readers before writers.
  Bytes expected(const std::vector<dds_entity_t>& writers,
                 const std::vector<dds_entity_t>& readers) const {
    Cdr cdr;
    put(cdr, participant_.entity().get());
    cdr.number<std::uint32_t>(1).text("/").text("orbwatch");
    put(cdr, readers);
    put(cdr, writers);
    return cdr.bytes();
  }

  tests::DdsNetwork network_;
  Participant participant_ = Participant::join(tests::DdsNetwork::kSinkDomain).value();
  Entity topic_ =
      make_topic(participant_.entity(), sensor_msgs_msg_dds__Image__desc, "rt/image").value();
  Entity writer_ = make_writer(participant_.entity(), topic_, frame_qos()).value();
  Entity other_writer_ = make_writer(participant_.entity(), topic_, frame_qos()).value();
  Entity reader_ = make_reader(participant_.entity(), topic_, frame_qos()).value();
  dds_topic_descriptor_t type_ = type_of(GetParam());
  DiscoveryInfo info_;
};

TEST_P(DiscoveryInfoTest, NamesTheNodeAndItsEndpointsToWhoeverComesLater) {
  ASSERT_TRUE(info_.open(participant_.entity(), GetParam()));
  const std::array writers{writer_.get(), other_writer_.get()};
  const std::array readers{reader_.get()};
  ASSERT_TRUE(info_.announce(writers, readers));
  const Reader late(type_, DiscoveryInfo::kTopic, state_qos());
  tests::Sample sample;
  ASSERT_TRUE(eventually([&] { return tests::take_bytes(late, sample); }));
  EXPECT_EQ(sample.header, (Bytes{0, 1}));
  EXPECT_EQ(sample.payload, expected({writer_.get(), other_writer_.get()}, {reader_.get()}));
}

TEST_P(DiscoveryInfoTest, TheNewestAnnouncementCounts) {
  ASSERT_TRUE(info_.open(participant_.entity(), GetParam()));
  ASSERT_TRUE(info_.announce(std::array{writer_.get()}, {}));
  ASSERT_TRUE(info_.announce({}, {}));
  const Reader late(type_, DiscoveryInfo::kTopic, state_qos());
  tests::Sample sample;
  ASSERT_TRUE(eventually([&] { return tests::take_bytes(late, sample); }));
  EXPECT_EQ(sample.payload, expected({}, {}));
  ASSERT_TRUE(info_.announce({}, std::array{reader_.get()}));
  ASSERT_TRUE(eventually([&] { return tests::take_bytes(late, sample); }));
  EXPECT_EQ(sample.payload, expected({}, {reader_.get()}));
}

TEST_P(DiscoveryInfoTest, IsAnnouncedAsRos2Does) {
  ASSERT_TRUE(info_.open(participant_.entity(), GetParam()));
  const Reader reader(type_, DiscoveryInfo::kTopic, state_qos());
  tests::Announcement told;
  ASSERT_TRUE(eventually([&] { return tests::announcement(reader.get(), told); }));
  EXPECT_EQ(told.topic, "ros_discovery_info");
  EXPECT_EQ(told.type, kType);
  EXPECT_EQ(told.reliability, DDS_RELIABILITY_RELIABLE);
  EXPECT_EQ(told.durability, DDS_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_EQ(told.history, DDS_HISTORY_KEEP_LAST);
  EXPECT_EQ(told.depth, 1);
  ASSERT_FALSE(told.representations.empty());
  EXPECT_EQ(told.representations[0], DDS_DATA_REPRESENTATION_XCDR1);
  EXPECT_EQ(
      told.user_data,
      GetParam() == RosGeneration::Iron
          ? "typehash=RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e;"
          : "");
}

TEST_P(DiscoveryInfoTest, OpensAgainAfterClosing) {
  ASSERT_TRUE(info_.open(participant_.entity(), GetParam()));
  info_.close();
  EXPECT_FALSE(info_.announce({}, {}));
  ASSERT_TRUE(info_.open(participant_.entity(), GetParam()));
  EXPECT_TRUE(info_.announce({}, {}));
}

TEST_P(DiscoveryInfoTest, RefusesWhatIsNoEndpoint) {
  EXPECT_FALSE(info_.announce({}, {})) << "not open";
  ASSERT_TRUE(info_.open(participant_.entity(), GetParam()));
  const dds_entity_t deleted = writer_.get();
  writer_.reset();
  const auto announced = info_.announce(std::array{deleted}, {});
  ASSERT_FALSE(announced);
  EXPECT_TRUE(announced.error().message.starts_with("DDS GUID of an endpoint"))
      << announced.error().message;
  EXPECT_FALSE(info_.open(Entity(), GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Generations, DiscoveryInfoTest,
                         testing::Values(RosGeneration::Humble, RosGeneration::Iron),
                         [](const auto& generation) {
                           return generation.param == RosGeneration::Humble ? "Humble" : "Iron";
                         });

}  // namespace
}  // namespace orbwatch::app::dds
