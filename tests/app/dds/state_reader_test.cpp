// The process state from the sink to whoever reads it, field by field over a real DDS network.
#include "app/dds/state_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/dds/dds_sink.h"
#include "app/dds/topic_names.h"
#include "tests/app/dds/foreign_writer.h"
#include "tests/app/dds/same_status.h"
#include "tests/app/dds/test_status.h"

namespace orbwatch::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using tests::DdsNetwork;
using tests::eventually;

class StateReaderTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }

  /// The next state; fails the test when there is none.
  ReceivedState next(StateReader& reader) const {
    Result<std::optional<ReceivedState>> state;
    EXPECT_TRUE(eventually([&] {
      state = reader.next(milliseconds(20));
      return !state || state->has_value();
    }));
    EXPECT_TRUE(state) << state.error().message;
    return state && *state ? **state : ReceivedState{};
  }

  DdsNetwork network_;
};

TEST_F(StateReaderTest, EveryFieldArrivesAtALateJoiner) {
  DdsSink sink({.domain = DdsNetwork::kSinkDomain}, tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  Status status = tests::make_status();
  const auto now = hal::Clock::now();
  status.cameras[0].last_frame = now - seconds(1000);
  status.alarms[2].since = now - seconds(5000);
  sink.accept(status);
  ASSERT_TRUE(eventually([&] {
    const auto statistics = sink.statistics();
    return std::ranges::any_of(statistics.topics, [](const TopicStatistics& topic) {
      return topic.topic == "rt/orbwatch/process_state" && topic.written == 1;
    });
  }));

  StateReader late("orbwatch");
  ASSERT_TRUE(late.open(DdsNetwork::kReaderDomain));
  const ReceivedState state = next(late);
  tests::expect_same(state.report.status, status);
  const auto names = tests::make_names();
  EXPECT_EQ(state.report.names.cameras, names.cameras);
  EXPECT_EQ(state.report.names.views, names.views);
  EXPECT_EQ(state.report.names.regions, names.regions);
  EXPECT_EQ(state.commands, CommandCounts{});
  const StatusTimes& times = state.report.times;
  EXPECT_LT(std::chrono::abs(times.stamp - hal::to_utc(status.stamp)), seconds(1));
  EXPECT_GE(times.last_frame_age_s[0], 1000);
  EXPECT_LT(times.last_frame_age_s[0], 1000 + 60);
  EXPECT_TRUE(std::isnan(times.last_frame_age_s[1])) << "no frame yet";
  EXPECT_GE(times.alarm_age_s[2], 5000);
  EXPECT_LT(times.alarm_age_s[2], 5000 + 60);
  EXPECT_TRUE(std::isnan(times.alarm_age_s[0])) << "always in this state";
}

TEST_F(StateReaderTest, TheNewestWins) {
  DdsSink sink({.domain = DdsNetwork::kSinkDomain}, tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  StateReader reader("orbwatch");
  ASSERT_TRUE(reader.open(DdsNetwork::kReaderDomain));
  Status status = tests::make_status();
  for (status.heartbeat = 1; status.heartbeat < 50; ++status.heartbeat) sink.accept(status);
  sink.accept(status);
  std::uint64_t last = 0;
  ASSERT_TRUE(eventually([&] {
    const auto state = reader.next(milliseconds(20));
    if (!state || !*state) return false;
    EXPECT_GT((**state).report.status.heartbeat, last) << "older than the one before";
    last = (**state).report.status.heartbeat;
    return last == 50;
  }));
  EXPECT_FALSE(*reader.next(milliseconds(0))) << "nothing new";
}

TEST_F(StateReaderTest, AnEmptyStateIsOne) {
  DdsSink sink({.domain = DdsNetwork::kSinkDomain}, {}, nullptr);
  ASSERT_TRUE(sink.start());
  sink.accept(Status{});
  StateReader reader("orbwatch");
  ASSERT_TRUE(reader.open(DdsNetwork::kReaderDomain));
  const ReceivedState state = next(reader);
  EXPECT_EQ(tests::figures(state.report.status), tests::figures(Status{}));
  EXPECT_TRUE(std::isnan(state.report.status.health.disk_free));
  EXPECT_EQ(state.report.times.stamp, std::chrono::system_clock::time_point{});
}

TEST_F(StateReaderTest, RefusesWhatDoesNotAddUp) {
  const tests::ForeignWriter writer(DdsNetwork::kSinkDomain,
                                    orbwatch_msgs_msg_dds__ProcessState__desc,
                                    process_state_topic("orbwatch"), state_qos());
  StateReader reader("orbwatch");
  ASSERT_TRUE(reader.open(DdsNetwork::kReaderDomain));
  ASSERT_TRUE(writer.wait_for_reader());
  const auto refusal = [&](const ProcessStateMessage& message) -> std::string {
    const std::string before = reader.refusal();
    writer.write(&message);
    bool taken = false;
    EXPECT_TRUE(eventually([&] {
      const auto state = reader.next(milliseconds(20));
      EXPECT_TRUE(state) << state.error().message;
      taken = state && state->has_value();
      return taken || reader.refusal() != before;
    }));
    return taken ? "" : reader.refusal();
  };
  ProcessStateComposer composer(tests::make_names());
  const auto good = [&]() -> ProcessStateMessage {
    return composer.compose(tests::make_status(), {}, {});
  };
  EXPECT_EQ(refusal(good()), "");

  ProcessStateMessage bad = good();
  bad.system_state = 5;
  EXPECT_THAT(refusal(bad), HasSubstr("system state 5, 0 to 4 are known"));
  bad = good();
  bad.regions._buffer[1].quality = 3;
  EXPECT_THAT(refusal(bad), HasSubstr("quality 3"));
  bad = good();
  bad.cameras._buffer[0].fault = 6;
  EXPECT_THAT(refusal(bad), HasSubstr("camera fault 6"));
  bad = good();
  bad.alarms._buffer[0].state = 7;
  EXPECT_THAT(refusal(bad), HasSubstr("alarm state 7"));
  bad = good();
  bad.alarms._buffer[0].level = 6;
  EXPECT_THAT(refusal(bad), HasSubstr("alarm level 6"));
  bad = good();
  bad.alarms._buffer[0].announced = 255;
  EXPECT_THAT(refusal(bad), HasSubstr("alarm level 255"));
  bad = good();
  std::string unknown = "\x1b[2Jsignal";
  bad.alarms._buffer[0].signal = unknown.data();
  EXPECT_THAT(refusal(bad), HasSubstr("unknown signal"));
  EXPECT_EQ(refusal(good()), "") << "a bad one does no lasting harm";
}

TEST_F(StateReaderTest, RefusesListsThatAreTooLong) {
  std::string name = "x";
  std::vector<orbwatch_msgs_msg_dds__ViewStatus_> views(kMaxViews + 1);
  for (auto& view : views) view.name = name.data();
  ProcessStateMessage message{};
  const auto count = static_cast<std::uint32_t>(views.size());
  message.views = {count, count, views.data(), false};
  const auto checked = check_process_state(message);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr("17 views, at most 16"));
}

}  // namespace
}  // namespace orbwatch::app
