// SPDX-License-Identifier: Apache-2.0
// Transfers the process state from the sink to a reader, field by field over a real DDS network.
#include "app/cli/dds/received_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/ports/dds/figures.h"
#include "tests/app/ports/dds/foreign_writer.h"
#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app::cli {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using tests::DdsNetwork;
using tests::eventually;

class StateReaderTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }

  /// Calls `look` with the next state; fails the test when there is none.
  static void next(StateReader& reader, const AcceptState& look) {
    EXPECT_TRUE(eventually([&] {
      const auto accepted = reader.next(milliseconds(20), look);
      EXPECT_TRUE(accepted) << accepted.error().message;
      return !accepted || *accepted;
    }));
  }

  DdsNetwork network_;
};

TEST_F(StateReaderTest, EveryFieldArrivesAtALateJoiner) {
  dds::DdsSink sink({.domain = DdsNetwork::kSinkDomain}, tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  Status status = tests::make_status();
  const auto now = hal::Clock::now();
  status.cameras[0].last_frame = now - seconds(1000);
  status.alarms[2].since = now - seconds(5000);
  sink.accept(status);
  ASSERT_TRUE(eventually([&] {
    const auto statistics = sink.statistics();
    return std::ranges::any_of(statistics.topics, [](const dds::TopicStatistics& topic) {
      return topic.topic == "rt/orbwatch/process_state" && topic.written == 1;
    });
  }));

  StateReader late("orbwatch");
  ASSERT_TRUE(late.open(DdsNetwork::kReaderDomain));
  auto expected = status_readings({status, tests::make_names(), now, {}});
  expected.push_back(
      {{"commands"}, {{"done", 0}, {"refused", 0}, {"repeated", 0}, {"dropped", 0}}});
  next(late, [&](const ReceivedState& state) {
    tests::expect_same(state.components, expected);
    EXPECT_EQ(state.frame_set, status.frame_set);
    EXPECT_EQ(state.trigger, status.trigger);
    EXPECT_EQ(state.result, status.result);
    EXPECT_EQ(state.recipe, status.recipe);
    EXPECT_EQ(state.configuration_checksum, status.configuration_checksum);
    EXPECT_EQ(state.system_state, status.state);
    EXPECT_EQ(state.heartbeat, status.heartbeat);
    EXPECT_LT(std::chrono::abs(state.stamp - hal::to_utc(status.stamp)), seconds(1));
  });
}

TEST_F(StateReaderTest, TheNewestWins) {
  dds::DdsSink sink({.domain = DdsNetwork::kSinkDomain}, tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  StateReader reader("orbwatch");
  ASSERT_TRUE(reader.open(DdsNetwork::kReaderDomain));
  Status status = tests::make_status();
  for (status.heartbeat = 1; status.heartbeat < 50; ++status.heartbeat) sink.accept(status);
  sink.accept(status);
  std::uint64_t last = 0;
  ASSERT_TRUE(eventually([&] {
    EXPECT_TRUE(reader.next(milliseconds(20), [&](const ReceivedState& state) {
      EXPECT_GT(state.heartbeat, last) << "older than the one before";
      last = state.heartbeat;
    }));
    return last == 50;
  }));
  EXPECT_FALSE(*reader.next(milliseconds(0), [](const ReceivedState&) {})) << "nothing new";
}

TEST_F(StateReaderTest, AnEmptyStateIsOne) {
  dds::DdsSink sink({.domain = DdsNetwork::kSinkDomain}, {}, nullptr);
  ASSERT_TRUE(sink.start());
  sink.accept(Status{});
  StateReader reader("orbwatch");
  ASSERT_TRUE(reader.open(DdsNetwork::kReaderDomain));
  next(reader, [](const ReceivedState& state) {
    auto expected = status_readings({Status{}, {}, {}, {}});
    expected.push_back(
        {{"commands"}, {{"done", 0}, {"refused", 0}, {"repeated", 0}, {"dropped", 0}}});
    tests::expect_same(state.components, expected);
    EXPECT_EQ(state.system_state, SystemState::Starting);
    EXPECT_EQ(state.heartbeat, 0u);
    EXPECT_EQ(state.stamp, std::chrono::system_clock::time_point{});
  });
}

/// Process state with one component of one figure, whose parts a test may invalidate.
struct SmallState {
  std::string kind = "camera", name = "front", figure_name = "frames", unit = "1/s", text = "some";
  std::vector<dds::FigureMessage> figures{1};
  std::vector<dds::ComponentMessage> components{1};
  std::uint8_t system_state = 1;

  const dds::ProcessStateMessage& message() {
    std::ranges::fill(figures, dds::FigureMessage{figure_name.data(), 7, unit.data(), text.data()});
    const auto figure_count = static_cast<std::uint32_t>(figures.size());
    std::ranges::fill(
        components,
        dds::ComponentMessage{
            kind.data(), name.data(), {figure_count, figure_count, figures.data(), false}});
    const auto count = static_cast<std::uint32_t>(components.size());
    message_.header.frame_id = frame_id_.data();
    message_.system_state = system_state;
    message_.components = {count, count, components.data(), false};
    return message_;
  }

 private:
  std::string frame_id_;
  dds::ProcessStateMessage message_{};
};

struct StateDamage {
  const char* name;
  std::function<void(SmallState&)> apply;
  const char* message;
};

/// Invalid states, each with its refusal.
std::vector<StateDamage> damages() {
  return {
      {"system state", [](auto& s) { s.system_state = 5; }, "system state 5 is unknown"},
      {"last system state", [](auto& s) { s.system_state = 255; }, "system state 255 is unknown"},
      {"no kind", [](auto& s) { s.kind.clear(); }, "the kind of a component is not snake_case"},
      {"kind for a terminal", [](auto& s) { s.kind = "\x1b[2Jkind"; }, "the kind of a component"},
      {"figure for a terminal", [](auto& s) { s.figure_name = "\x1b[2Jname"; },
       "the name of a figure is not snake_case"},
      {"figure in capitals", [](auto& s) { s.figure_name = "Frames"; }, "the name of a figure"},
      {"long kind", [](auto& s) { s.kind.assign(kMaxTextLength + 1, 'x'); },
       "a text of more than 1000 bytes"},
      {"long name", [](auto& s) { s.name.assign(kMaxTextLength + 1, 'x'); }, "a text of more than"},
      {"long unit", [](auto& s) { s.unit.assign(kMaxTextLength + 1, 'x'); }, "a text of more than"},
      {"long text", [](auto& s) { s.text.assign(kMaxTextLength + 1, 'x'); }, "a text of more than"},
      {"components", [](auto& s) { s.components.resize(kMaxListLength + 1); },
       "1001 components, at most 1000 are accepted"},
      {"figures", [](auto& s) { s.figures.resize(kMaxListLength + 1); },
       "1001 figures, at most 1000 are accepted"},
  };
}

TEST(CheckProcessState, RefusesWhatIsInvalidWithoutQuotingIt) {
  SmallState good;
  ASSERT_TRUE(check_process_state(good.message()));
  for (const StateDamage& damage : damages()) {
    SmallState bad;
    damage.apply(bad);
    const auto checked = check_process_state(bad.message());
    ASSERT_FALSE(checked) << damage.name;
    EXPECT_THAT(checked.error().message, HasSubstr(damage.message)) << damage.name;
    EXPECT_EQ(checked.error().message.find('\x1b'), std::string::npos) << damage.name;
  }
}

TEST(CheckProcessState, AcceptsTheLongest) {
  SmallState state;
  state.name.assign(kMaxTextLength, 'x');
  state.components.resize(kMaxListLength);
  const auto checked = check_process_state(state.message());
  ASSERT_TRUE(checked) << checked.error().message;
  EXPECT_EQ(checked->components.size(), kMaxListLength);
}

TEST_F(StateReaderTest, SkipsInvalidStates) {
  const tests::ForeignWriter writer(DdsNetwork::kSinkDomain,
                                    orbwatch_msgs_msg_dds__ProcessState__desc,
                                    dds::process_state_topic("orbwatch"), dds::state_qos());
  StateReader reader("orbwatch");
  ASSERT_TRUE(reader.open(DdsNetwork::kReaderDomain));
  ASSERT_TRUE(writer.wait_for_reader());
  const auto refusal = [&](const dds::ProcessStateMessage& message) -> std::string {
    const std::string before = reader.refusal();
    writer.write(&message);
    bool accepted = false;
    EXPECT_TRUE(eventually([&] {
      EXPECT_TRUE(reader.next(milliseconds(20), [&](const auto&) { accepted = true; }));
      return accepted || reader.refusal() != before;
    }));
    return accepted ? "" : reader.refusal();
  };
  SmallState state;
  EXPECT_EQ(refusal(state.message()), "");
  state.system_state = 5;
  EXPECT_THAT(refusal(state.message()), HasSubstr("system state 5 is unknown"));
  state.system_state = 4;
  state.kind = "\x1b[2Jkind";
  EXPECT_THAT(refusal(state.message()), HasSubstr("kind of a component"));
  state.kind = "camera";
  EXPECT_EQ(refusal(state.message()), "") << "an invalid one does no lasting harm";
}

}  // namespace
}  // namespace orbwatch::app::cli
