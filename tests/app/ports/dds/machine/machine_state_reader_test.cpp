// SPDX-License-Identifier: Apache-2.0
// States of the machine over a real DDS network.
#include "app/ports/dds/machine/machine_state_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <mutex>
#include <vector>

#include "app/machine/machine_follower.h"
#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/ports/dds/foreign_writer.h"

namespace orbwatch::app::dds {
namespace {

using tests::DdsNetwork;
using tests::eventually;
using tests::ForeignWriter;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

MachineStateMessage message(std::uint32_t number, double clock, const char* part) {
  MachineStateMessage message{};
  message.number = number;
  message.clock = clock;
  std::snprintf(message.part, sizeof message.part, "%s", part);
  message.layer = 3;
  message.x = -12.5;
  message.powder_flow = kUnknown;
  return message;
}

/// States that the sink handed over.
class TakenStates {
 public:
  MachinePath path() {
    return {MachineSource::Dds, [this](const MachineState& state) -> Result<> {
              const std::lock_guard lock(mutex_);
              states_.push_back(state);
              return {};
            }};
  }
  std::vector<MachineState> states() const {
    const std::lock_guard lock(mutex_);
    return states_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<MachineState> states_;
};

class MachineStates : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }

  void start() { start(machine_.path()); }
  void start(const MachinePath& path) {
    sink_.emplace(DdsSettings{.domain = DdsNetwork::kSinkDomain}, StatusNames{{}, {"front"}, {}},
                  nullptr, network_addresses, std::make_shared<CommandRecord>(),
                  hal::SharedThreads::alone(), ApplianceIdentity{}, nullptr,
                  std::vector<PublishedView>{}, std::vector<PublishedCamera>{}, path);
    const auto started = sink_->start();
    ASSERT_TRUE(started) << started.error().message;
  }

  static ForeignWriter controller(Qos qos) {
    return {DdsNetwork::kReaderDomain, orbwatch_msgs_msg_dds__MachineState__desc,
            machine_state_topic("orbwatch"), std::move(qos)};
  }

  DdsNetwork network_;
  TakenStates machine_;
  machine::MachineFollower follower_{{.source = MachineSource::Dds}};
  std::optional<DdsSink> sink_;
};

TEST_F(MachineStates, ArriveFromReliableAndFromBestEffortWriters) {
  start();
  for (Qos (*qos)() : {command_qos, machine_state_qos}) {
    const ForeignWriter writer = controller(qos());
    ASSERT_TRUE(writer.wait_for_reader());
    const std::size_t before = machine_.states().size();
    const MachineStateMessage sent = message(7, 42.5, "Flügel");
    EXPECT_TRUE(eventually([&] {
      writer.write(&sent);
      return machine_.states().size() > before;
    }));
  }
  const MachineState state = machine_.states().back();
  EXPECT_EQ(state.sequence, 7U);
  EXPECT_EQ(state.clock, 42.5);
  EXPECT_EQ(state.part.text(), "Flügel");
  EXPECT_EQ(state.values.layer, 3);
  EXPECT_EQ(state.values.x, -12.5);
  EXPECT_TRUE(std::isnan(state.values.powder_flow));
}

TEST_F(MachineStates, WithoutAClockTheTimeOfWritingCounts) {
  start();
  const ForeignWriter writer = controller(command_qos());
  ASSERT_TRUE(writer.wait_for_reader());
  const auto utc = [] {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  };
  const double before = utc();
  const MachineStateMessage sent = message(1, kUnknown, "");
  EXPECT_TRUE(eventually([&] {
    writer.write(&sent);
    return !machine_.states().empty();
  }));
  const double clock = machine_.states().front().clock;
  EXPECT_GE(clock, before - 1e-6);
  EXPECT_LE(clock, utc() + 1e-6);
}

TEST_F(MachineStates, ANameThatIsNotUtf8IsRefused) {
  start();
  const ForeignWriter writer = controller(command_qos());
  ASSERT_TRUE(writer.wait_for_reader());
  const MachineStateMessage bad = message(1, 1, "\xff\xfe"), good = message(2, 2, "good");
  EXPECT_TRUE(eventually([&] {
    writer.write(&bad);
    writer.write(&good);
    return !machine_.states().empty();
  }));
  for (const MachineState& state : machine_.states()) EXPECT_EQ(state.part.text(), "good");
}

TEST_F(MachineStates, ANameThatIsNotUtf8IsCounted) {
  start(follower_.path());
  const ForeignWriter writer = controller(command_qos());
  ASSERT_TRUE(writer.wait_for_reader());
  const MachineStateMessage bad = message(1, 1, "\xff");
  EXPECT_TRUE(eventually([&] {
    writer.write(&bad);
    return follower_.keep(hal::Clock::now()).refused > 0;
  }));
  EXPECT_EQ(follower_.keep(hal::Clock::now()).states, 0U);
}

}  // namespace
}  // namespace orbwatch::app::dds
