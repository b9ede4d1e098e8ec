// SPDX-License-Identifier: Apache-2.0
// Appliances that receive each other's announcements over the network, and messages of strangers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/fleet/appliance_message.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/foreign_writer.h"
#include "tests/app/ports/dds/sink_topics.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"

namespace orbwatch::app::dds {
namespace {

using tests::DdsNetwork;
using tests::eventually;
using tests::ForeignWriter;

/// The same type on the wire, except for the bounds.
struct LooseAppliance {
  char *name, *version, *prefix, *page_address;
  std::uint16_t page_port;
  std::uint8_t system_state, severity;
  char* condition;
  std::uint32_t alarms;
  std::uint8_t alarm_severity;
  char* alarm;
};

constexpr std::uint32_t operation(dds_stream_typecode type, dds_stream_typecode of = {}) {
  return std::uint32_t{DDS_OP_ADR} | std::uint32_t{type} << 16U | std::uint32_t{of} << 8U;
}

/// The descriptor that idlc would generate for it.
dds_topic_descriptor_t loose_type() {
  using Loose = LooseAppliance;
  constexpr std::uint32_t kText = operation(DDS_OP_VAL_STR), kByte = operation(DDS_OP_VAL_1BY);
  static const std::array<std::uint32_t, 23> kOperations{kText,
                                                         offsetof(Loose, name),
                                                         kText,
                                                         offsetof(Loose, version),
                                                         kText,
                                                         offsetof(Loose, prefix),
                                                         kText,
                                                         offsetof(Loose, page_address),
                                                         operation(DDS_OP_VAL_2BY),
                                                         offsetof(Loose, page_port),
                                                         kByte,
                                                         offsetof(Loose, system_state),
                                                         kByte,
                                                         offsetof(Loose, severity),
                                                         kText,
                                                         offsetof(Loose, condition),
                                                         operation(DDS_OP_VAL_4BY),
                                                         offsetof(Loose, alarms),
                                                         kByte,
                                                         offsetof(Loose, alarm_severity),
                                                         kText,
                                                         offsetof(Loose, alarm),
                                                         DDS_OP_RTS};
  return {sizeof(Loose),
          alignof(Loose),
          0,
          0,
          orbwatch_msgs_msg_dds__Appliance__desc.m_typename,
          nullptr,
          12,
          kOperations.data(),
          "",
          {},
          {},
          {}};
}

dds_topic_descriptor_t endless_type() {
  static const std::array<std::uint32_t, 3> kOperations{
      operation(DDS_OP_VAL_SEQ, DDS_OP_VAL_1BY), offsetof(ThumbnailMessage, jpeg), DDS_OP_RTS};
  dds_topic_descriptor_t type = orbwatch_msgs_msg_dds__Thumbnail__desc;
  type.m_ops = kOperations.data();
  return type;
}

/// An appliance on its own computer.
struct Member {
  Member(int domain, const std::string& name)
      : sink({.domain = domain}, tests::make_names(), nullptr, network_addresses,
             std::make_shared<CommandRecord>(), hal::SharedThreads::alone(),
             {name, "1.2.3", "orbwatch", {"0.0.0.0", 8443}}, fleet) {}

  /// Runs one step of the appliance.
  void live() {
    Status status;
    status.state = SystemState::Running;
    status.selected_view = kFront;
    sink.accept(status);
    tests::hand_over(sink, tests::make_view(kFront, "front", 1, 320, 200));
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fleet->list(hal::Clock::now())) all.push_back(entry.notice.name);
    return all;
  }

  std::shared_ptr<Fleet> fleet = std::make_shared<Fleet>();
  DdsSink sink;
};

class FleetOnTheWire : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    ASSERT_TRUE(here_.sink.start());
  }
  template <class Condition>
  bool live_until(const Condition& condition, Member* there = nullptr) {
    return eventually([&] {
      here_.live();
      if (there) there->live();
      return condition();
    });
  }

  DdsNetwork network_;
  Member here_{DdsNetwork::kSinkDomain, "here"};
};

TEST_F(FleetOnTheWire, HearsItselfAndTheOthers) {
  Member there(DdsNetwork::kReaderDomain, "there");
  ASSERT_TRUE(there.sink.start());
  const std::vector<std::string> both{"here", "there"};
  ASSERT_TRUE(live_until([&] { return here_.names() == both && there.names() == both; }, &there));
  const auto entries = here_.fleet->list(hal::Clock::now());
  EXPECT_TRUE(entries[0].is_self);
  EXPECT_FALSE(entries[1].is_self);
  EXPECT_EQ(entries[1].notice.version, "1.2.3");
  EXPECT_EQ(entries[1].notice.state, SystemState::Running);
  EXPECT_EQ(url_of(entries[1].notice.page), "https://127.0.0.1:8443/") << "where DDS reaches it";
  there.sink.stop();
  const auto heard = here_.fleet->list(hal::Clock::now())[1].newest;
  EXPECT_TRUE(here_.fleet->list(heard + Fleet::kSilence + std::chrono::milliseconds(1))[1].is_gone);
}

TEST_F(FleetOnTheWire, TwoOfOneNameAreTwo) {
  Member there(DdsNetwork::kReaderDomain, "here");
  ASSERT_TRUE(there.sink.start());
  const std::vector<std::string> both{"here", "here"};
  EXPECT_TRUE(live_until([&] { return here_.names() == both && there.names() == both; }, &there));
}

TEST_F(FleetOnTheWire, ThumbnailsAreMadeOnlyForThoseWhoLook) {
  Member there(DdsNetwork::kReaderDomain, "there");
  ASSERT_TRUE(there.sink.start());
  ASSERT_TRUE(live_until([&] { return here_.names().size() == 2; }, &there));
  const auto id = here_.fleet->list(hal::Clock::now())[1].id;
  const auto written = [&] { return of_topic(there.sink, std::string(kThumbnailTopic)).written; };
  EXPECT_EQ(written(), 0U);
  EXPECT_FALSE(there.sink.needs(kFront, hal::Clock::now()).jpeg);
  here_.fleet->note_viewer(hal::Clock::now());
  ASSERT_TRUE(live_until([&] { return here_.fleet->picture(id) != nullptr; }, &there));
  const auto jpeg = *here_.fleet->picture(id);
  EXPECT_LT(jpeg.size(), 8000U);
  EXPECT_TRUE(eventually([&] { return written() > 0; })) << "counted behind the write";
  EXPECT_EQ(here_.fleet->counts().refused, 0U);
  EXPECT_EQ(there.fleet->picture(id), nullptr) << "nobody looked there";
}

TEST_F(FleetOnTheWire, AViewRenderedBeforeThumbnailsHadAReaderIsCountedAsUnread) {
  const std::string topic(kThumbnailTopic);
  const auto view = tests::make_view(kFront, "front", 1, 320, 200);
  view->picture = {};
  EXPECT_FALSE(here_.sink.needs(kFront, view->stamp).jpeg);
  const tests::TopicReader<ThumbnailMessage> reader(orbwatch_msgs_msg_dds__Thumbnail__desc, topic,
                                                    frame_qos());
  ASSERT_TRUE(eventually([&] { return of_topic(here_.sink, topic).readers > 0; }));
  here_.sink.accept(view);
  EXPECT_EQ(of_topic(here_.sink, topic).unread, 1U);
}

TEST_F(FleetOnTheWire, WhatIsTooLongOrWrongIsDropped) {
  const dds_topic_descriptor_t type = loose_type();
  const ForeignWriter stranger(DdsNetwork::kReaderDomain, type, std::string(kApplianceTopic),
                               state_qos());
  ASSERT_TRUE(stranger.wait_for_reader());
  std::string sound = "stranger", empty, longer(65, 'n'), huge(500'000, 'x'), wild = "\xff\x1b]0;";
  const auto sample = [&](std::string& name, std::string& alarm, std::uint8_t state) {
    return LooseAppliance{
        name.data(), empty.data(), empty.data(), empty.data(), 1, state, 0, empty.data(), 0,
        0,           alarm.data()};
  };
  std::uint64_t rounds = 0;
  ASSERT_TRUE(live_until([&] {  // the first samples are written before the reader matches
    ++rounds;
    for (const LooseAppliance& wrong : {sample(longer, empty, 1), sample(huge, empty, 1),
                                        sample(sound, huge, 1), sample(sound, empty, 77)}) {
      stranger.write(&wrong);
    }
    return here_.fleet->counts().refused > 0;
  }));
  const auto said = [&](const std::string& name) {
    const auto names = here_.names();
    return std::ranges::find(names, name) != names.end();
  };
  EXPECT_FALSE(said(sound));
  ASSERT_TRUE(live_until([&] {
    const LooseAppliance strange = sample(wild, empty, 1);
    stranger.write(&strange);
    return said("??]0;");
  }));
  EXPECT_LE(here_.fleet->counts().refused, rounds) << "Cyclone DDS drops the others";
  EXPECT_EQ(here_.names().size(), 2U);
}

TEST_F(FleetOnTheWire, PicturesOfStrangersAreSmallAndWholeOrNotThere) {
  here_.fleet->note_viewer(hal::Clock::now());
  const dds_topic_descriptor_t type = endless_type();
  const ForeignWriter stranger(DdsNetwork::kReaderDomain, type, std::string(kThumbnailTopic),
                               frame_qos());
  ASSERT_TRUE(live_until([&] { return stranger.has_reader(); }));
  std::vector<std::uint8_t> bytes(500'000, 0xd8);
  std::uint64_t rounds = 0;
  ASSERT_TRUE(live_until([&] {
    ++rounds;
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{16}, std::size_t{16384}, std::size_t{16385}, bytes.size()}) {
      const auto size = static_cast<std::uint32_t>(length);
      const ThumbnailMessage message{{size, size, bytes.data(), false}};
      stranger.write(&message);
    }
    return here_.fleet->counts().refused >= 3;
  }));
  EXPECT_LE(here_.fleet->counts().refused, 3 * rounds) << "Cyclone DDS drops what is too large";
}

}  // namespace
}  // namespace orbwatch::app::dds
