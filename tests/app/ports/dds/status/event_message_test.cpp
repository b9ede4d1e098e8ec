// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/event_message.h"

#include <gtest/gtest.h>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/ports/dds/figures.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/topic_reader.h"

namespace orbwatch::app::dds {
namespace {

using signals::AlarmEventKind;
using signals::AlarmLevel;
using signals::AlarmState;
using tests::eventually;

SignalNumber number_of(std::string_view signal) {
  std::uint16_t number = 0;
  while (operator_text(SignalNumber(number)) != signal) ++number;
  return SignalNumber(number);
}

AlarmNotice make_notice(std::uint64_t number) {
  AlarmNotice notice;
  notice.number = number;
  notice.event = {4,   AlarmEventKind::Raised, AlarmState::Unacknowledged, AlarmLevel::HighAlarm,
                  3.5, std::chrono::seconds(1)};
  notice.region = 1;
  notice.signal = number_of("hot_spot_width");
  notice.recipe = tests::kRecipe;
  notice.frame_set = 100 + number;
  notice.stamp = hal::Clock::now();
  return notice;
}

TEST(EventComposer, SeverityIsThatOfTheAlarmAfterTheEvent) {
  struct Case {
    AlarmState state;
    AlarmLevel level;
    int severity;
  };
  EventComposer composer;
  const StatusNames names = tests::make_names();
  for (const Case& c : {Case{AlarmState::Unacknowledged, AlarmLevel::HighAlarm, 2},
                        Case{AlarmState::Acknowledged, AlarmLevel::LowWarning, 1},
                        Case{AlarmState::LatchedUnacknowledged, AlarmLevel::HighAlarm, 2},
                        Case{AlarmState::ReturnedUnacknowledged, AlarmLevel::HighAlarm, 0},
                        Case{AlarmState::SuppressedByDesign, AlarmLevel::HighAlarm, 0},
                        Case{AlarmState::Normal, AlarmLevel::HighAlarm, 0}}) {
    AlarmNotice notice = make_notice(1);
    notice.event.state = c.state;
    notice.event.level = c.level;
    EXPECT_EQ(composer.compose(notice, names, {}).severity, c.severity) << operator_text(c.state);
  }
}

class EventMessageTest : public testing::Test {
 protected:
  class EventReader : public tests::TopicReader<EventMessage> {
   public:
    EventReader()
        : TopicReader(orbwatch_msgs_msg_dds__Event__desc, event_topic("orbwatch"), event_qos()) {}
  };

  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    ASSERT_TRUE(sink_.start());
  }

  std::uint64_t written() const {
    for (const TopicStatistics& topic : sink_.statistics().topics) {
      if (topic.topic == "rt/orbwatch/event") return topic.written;
    }
    return 0;
  }

  tests::DdsNetwork network_;
  DdsSink sink_{{.domain = tests::DdsNetwork::kSinkDomain}, tests::make_names(), nullptr};
};

TEST_F(EventMessageTest, EveryFieldArrives) {
  const EventReader reader;
  const AlarmNotice notice = make_notice(1);
  sink_.accept_event(notice);
  const auto look = [&](const EventMessage& event) {
    EXPECT_LT(std::chrono::abs(since_epoch(event.header.stamp) -
                               hal::to_utc(notice.stamp).time_since_epoch()),
              std::chrono::seconds(1));
    EXPECT_STREQ(event.header.frame_id, "");
    EXPECT_EQ(event.number, 1u);
    EXPECT_STREQ(event.kind, "alarm");
    EXPECT_STREQ(event.source, "5, edge: hot_spot_width")
        << "as the component of the process state";
    EXPECT_EQ(event.severity, 2);
    EXPECT_STREQ(event.text, "edge: hot_spot_width raised, high alarm, 3.5 mm");
    const auto value = [&](std::string_view name) {
      return tests::figure(event.figures, name).value;
    };
    const auto text = [&](std::string_view name) -> std::string {
      return tests::figure(event.figures, name).text;
    };
    EXPECT_EQ(event.figures._length, 11u);
    EXPECT_EQ(value("alarm"), 5) << "as acknowledge_alarm counts";
    EXPECT_EQ(value("event"), 0);
    EXPECT_EQ(text("event"), "raised");
    EXPECT_EQ(value("state"), 1);
    EXPECT_EQ(text("state"), "in alarm, not acknowledged");
    EXPECT_EQ(value("level"), 4);
    EXPECT_EQ(text("level"), "high alarm");
    EXPECT_EQ(value("value"), 3.5);
    EXPECT_STREQ(tests::figure(event.figures, "value").unit, "mm");
    EXPECT_EQ(text("signal"), "hot_spot_width");
    EXPECT_EQ(value("region"), 1);
    EXPECT_EQ(text("region"), "edge");
    EXPECT_EQ(value("recipe"), tests::kRecipe);
    EXPECT_EQ(value("frame_set"), 101);
  };
  EXPECT_TRUE(eventually([&] { return reader.take(look); }));
}

TEST_F(EventMessageTest, LateJoinersGetTheLastOnesInOrder) {
  constexpr std::uint64_t kNoted = 100;
  static_assert(kNoted > kEventDepth);
  for (std::uint64_t number = 1; number <= kNoted; ++number) {
    sink_.accept_event(make_notice(number));
  }
  ASSERT_TRUE(eventually([&] { return written() == kNoted; })) << "newest-wins does not do here";
  EXPECT_EQ(sink_.statistics().dropped_events, 0u);
  const EventReader late;
  for (std::uint64_t number = kNoted - kEventDepth + 1; number <= kNoted; ++number) {
    ASSERT_TRUE(eventually([&] {
      return late.take([&](const EventMessage& event) { EXPECT_EQ(event.number, number); });
    }));
  }
}

TEST_F(EventMessageTest, TooManyAtOnceAreCounted) {
  std::uint64_t noted = 0;
  // The sink writes as fast as possible, but eventually it is too slow for this rate.
  ASSERT_TRUE(eventually([&] {
    for (int i = 0; i < 1000; ++i) sink_.accept_event(make_notice(++noted));
    return sink_.statistics().dropped_events > 0;
  }));
  ASSERT_TRUE(eventually([&] { return written() + sink_.statistics().dropped_events == noted; }));
}

TEST_F(EventMessageTest, AStoppedSinkHoldsNothing) {
  sink_.stop();
  sink_.accept_event(make_notice(1));
  ASSERT_TRUE(sink_.start());
  sink_.accept_event(make_notice(2));
  const EventReader reader;
  EXPECT_TRUE(eventually(
      [&] { return reader.take([](const EventMessage& event) { EXPECT_EQ(event.number, 2u); }); }));
}

}  // namespace
}  // namespace orbwatch::app::dds
