#include "app/dds/alarm_event.h"

#include <gtest/gtest.h>

#include "app/dds/dds_sink.h"
#include "app/dds/topic_names.h"
#include "tests/app/dds/test_status.h"
#include "tests/app/dds/topic_reader.h"

namespace orbwatch::app {
namespace {

using signals::AlarmEventKind;
using signals::AlarmLevel;
using signals::AlarmState;
using tests::eventually;

std::size_t index_of(std::string_view signal) {
  std::size_t index = 0;
  while (signals::kSignals[index].name != signal) ++index;
  return index;
}

AlarmNotice make_notice(std::uint64_t number) {
  AlarmNotice notice;
  notice.number = number;
  notice.event = {4,   AlarmEventKind::Raised, AlarmState::Unacknowledged, AlarmLevel::HighAlarm,
                  3.5, std::chrono::seconds(1)};
  notice.region = 1;
  notice.signal = index_of("hot_spot_width");
  notice.recipe = tests::kRecipe;
  notice.frame_set = 100 + number;
  notice.stamp = hal::Clock::now();
  return notice;
}

TEST(NoticeText, SaysWhatHappenedWhere) {
  AlarmNotice notice = make_notice(1);
  EXPECT_EQ(notice_text(notice, tests::make_names()),
            "edge: hot_spot_width raised, high alarm, 3.5 mm");
  notice.recipe = 1;  // whose regions have no names
  notice.event.kind = AlarmEventKind::Cleared;
  notice.event.value = signals::kNotValid;
  EXPECT_EQ(notice_text(notice, tests::make_names()),
            "region 2: hot_spot_width cleared, high alarm, not measured");
}

class AlarmEventTest : public testing::Test {
 protected:
  class EventReader : public tests::TopicReader<AlarmEventMessage> {
   public:
    EventReader()
        : TopicReader(orbwatch_msgs_msg_dds__AlarmEvent__desc, event_topic("orbwatch"),
                      event_qos()) {}
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

TEST_F(AlarmEventTest, EveryFieldArrives) {
  const EventReader reader;
  const AlarmNotice notice = make_notice(1);
  sink_.note(notice);
  const auto look = [&](const AlarmEventMessage& event) {
    EXPECT_LT(
        std::chrono::abs(since_epoch(event.stamp) - hal::to_utc(notice.stamp).time_since_epoch()),
        std::chrono::seconds(1));
    EXPECT_EQ(event.number, 1u);
    EXPECT_EQ(event.frame_set, 101u);
    EXPECT_EQ(event.recipe, tests::kRecipe);
    EXPECT_EQ(event.alarm, 5u) << "as acknowledge_alarm counts";
    EXPECT_EQ(event.region, 1u);
    EXPECT_STREQ(event.signal, "hot_spot_width");
    EXPECT_EQ(event.kind, 0);
    EXPECT_EQ(event.state, 1);
    EXPECT_EQ(event.level, 4);
    EXPECT_EQ(event.value, 3.5);
    EXPECT_STREQ(event.text, "edge: hot_spot_width raised, high alarm, 3.5 mm");
  };
  EXPECT_TRUE(eventually([&] { return reader.take(look); }));
}

TEST_F(AlarmEventTest, LateJoinersGetTheLastOnesInOrder) {
  constexpr std::uint64_t kNoted = 100;
  static_assert(kNoted > kEventDepth);
  for (std::uint64_t number = 1; number <= kNoted; ++number) {
    sink_.note(make_notice(number));
  }
  ASSERT_TRUE(eventually([&] { return written() == kNoted; })) << "newest-wins does not do here";
  EXPECT_EQ(sink_.statistics().dropped_notices, 0u);
  const EventReader late;
  for (std::uint64_t number = kNoted - kEventDepth + 1; number <= kNoted; ++number) {
    ASSERT_TRUE(eventually([&] {
      return late.take([&](const AlarmEventMessage& event) { EXPECT_EQ(event.number, number); });
    }));
  }
}

TEST_F(AlarmEventTest, TooManyAtOnceAreCounted) {
  std::uint64_t noted = 0;
  // The sink writes as fast as it can; sooner or later it is too slow for this.
  ASSERT_TRUE(eventually([&] {
    for (int i = 0; i < 1000; ++i) sink_.note(make_notice(++noted));
    return sink_.statistics().dropped_notices > 0;
  }));
  ASSERT_TRUE(eventually([&] { return written() + sink_.statistics().dropped_notices == noted; }));
}

TEST_F(AlarmEventTest, AStoppedSinkHoldsNothing) {
  sink_.stop();
  sink_.note(make_notice(1));
  ASSERT_TRUE(sink_.start());
  sink_.note(make_notice(2));
  const EventReader reader;
  EXPECT_TRUE(eventually([&] {
    return reader.take([](const AlarmEventMessage& event) { EXPECT_EQ(event.number, 2u); });
  }));
}

}  // namespace
}  // namespace orbwatch::app
