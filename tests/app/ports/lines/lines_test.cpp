// SPDX-License-Identifier: Apache-2.0
#include "app/ports/lines/lines.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace orbwatch::app {
namespace {

using signals::AlarmLevel;
using signals::AlarmState;

LineSettings line(const std::string& name, LineUse use, const std::string& wire) {
  LineSettings settings;
  settings.name = name;
  settings.use = use;
  settings.back_end = LineKind::Simulated;
  settings.wire.address.name = wire;
  settings.watchdog.timeout = std::chrono::minutes(1);  // the test reports rarely
  return settings;
}

/// Both outputs for the pipeline's state, wired to inputs.
class StatusLines : public testing::Test {
 protected:
  StatusLines() {
    lines = std::make_unique<Lines>(std::vector{line("hears_ok", LineUse::ProcessInput, "OK"),
                                                line("hears_alarm", LineUse::ProcessInput, "ALARM"),
                                                line("ok", LineUse::ProcessOk, "OK"),
                                                line("alarm", LineUse::Alarm, "ALARM")});
    EXPECT_TRUE(lines->start());
  }
  ~StatusLines() override { lines->stop(); }

  static Status status(SystemState state) {
    Status status;
    status.state = state;
    return status;
  }
  static Status status(AlarmState state, AlarmLevel level) {
    Status alarmed = status(SystemState::Running);
    alarmed.alarm_count = 2;  // the first one is normal
    alarmed.alarms[1].alarm = {state, level, level, false};
    return alarmed;
  }
  /// Reports a status until both lines have the expected state.
  bool becomes(const Status& status, bool ok, bool no_alarm) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    const auto is = [&](std::size_t input, bool active) {
      return lines->process_inputs()[input]->active() == active;
    };
    lines->accept(status);
    while (!(is(0, ok) && is(1, no_alarm)) && std::chrono::steady_clock::now() < end) {
      std::this_thread::yield();
    }
    return is(0, ok) && is(1, no_alarm);
  }

  std::unique_ptr<Lines> lines;
};

TEST_F(StatusLines, FollowTheState) {
  EXPECT_TRUE(becomes(status(SystemState::Starting), false, false));
  EXPECT_TRUE(becomes(status(SystemState::Running), true, true));
  EXPECT_TRUE(becomes(status(SystemState::Degraded), true, false)) << "a camera has a fault";
  EXPECT_TRUE(becomes(status(SystemState::Stopped), true, true)) << "was told to, and works";
  EXPECT_TRUE(becomes(status(SystemState::Fault), false, false));
  EXPECT_TRUE(becomes(status(SystemState::Running), true, true));
}

TEST_F(StatusLines, TheAlarmLineFallsWithAlarmsThatStandNotWithWarnings) {
  const auto falls = [&](AlarmState state, AlarmLevel level) {
    EXPECT_TRUE(becomes(status(SystemState::Running), true, true));
    return becomes(status(state, level), true, false);
  };
  EXPECT_TRUE(falls(AlarmState::Unacknowledged, AlarmLevel::HighAlarm));
  EXPECT_TRUE(falls(AlarmState::Acknowledged, AlarmLevel::LowAlarm)) << "it still stands";
  EXPECT_TRUE(falls(AlarmState::LatchedUnacknowledged, AlarmLevel::HighAlarm));
  EXPECT_TRUE(falls(AlarmState::LatchedAcknowledged, AlarmLevel::HighAlarm));
  const auto stays = [&](AlarmState state, AlarmLevel level) {
    EXPECT_TRUE(becomes(status(SystemState::Fault), false, false));
    return becomes(status(state, level), true, true);
  };
  EXPECT_TRUE(stays(AlarmState::ReturnedUnacknowledged, AlarmLevel::HighAlarm));
  EXPECT_TRUE(stays(AlarmState::SuppressedByDesign, AlarmLevel::HighAlarm));
  EXPECT_TRUE(stays(AlarmState::Unacknowledged, AlarmLevel::HighWarning));
  EXPECT_TRUE(stays(AlarmState::Unacknowledged, AlarmLevel::NoMeasurement));
}

TEST_F(StatusLines, AlarmsBeyondTheirCountAreNone) {
  Status left = status(AlarmState::Unacknowledged, AlarmLevel::HighAlarm);
  left.alarm_count = 1;
  EXPECT_TRUE(becomes(left, true, true));
}

/// Calls make_safe() while the owner is blocked elsewhere.
TEST_F(StatusLines, AreMadeSafeByAnotherThread) {
  EXPECT_TRUE(becomes(status(SystemState::Running), true, true));
  std::thread([this] { lines->make_safe(); }).join();
  ASSERT_TRUE(lines->start()) << "the inputs see what became of the outputs";
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (lines->process_inputs()[0]->active() == true && std::chrono::steady_clock::now() < end) {
    std::this_thread::yield();
  }
  EXPECT_EQ(lines->process_inputs()[0]->active(), false);
}

TEST(MissingLines, AreFaultsUntilTheyCome) {
  std::atomic<bool> there = false;
  Lines lines({line("door", LineUse::ProcessInput, "DOOR"), line("ok", LineUse::ProcessOk, "OK")},
              [&there](const std::string& name) { return name == "DOOR" || there; });
  EXPECT_EQ(lines.faults(), 0b10U) << "bit 1: the second line";
  ASSERT_TRUE(lines.start());
  there = true;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (lines.faults() != 0 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_EQ(lines.faults(), 0U);
  lines.stop();
}

TEST(MissingLines, TakeNoPulseUntilTheyCome) {
  std::atomic<bool> there = false;
  Lines lines(
      {line("door", LineUse::ProcessInput, "DOOR"), line("lamp", LineUse::TriggerOut, "LAMP"),
       line("start", LineUse::TriggerOut, "START")},
      [&there](const std::string& name) { return name != "START" || there; });
  ASSERT_TRUE(lines.start());
  EXPECT_EQ(lines.pulse(0), CommandResult::Done) << "of the line that is there";
  EXPECT_EQ(lines.pulse(1), CommandResult::NotPossible);
  EXPECT_EQ(lines.pulse(2), CommandResult::ArgumentOutOfRange);
  there = true;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (lines.faults() != 0 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_EQ(lines.pulse(1), CommandResult::Done);
  lines.stop();
}

TEST(StopLine, AsksWhenItIsHeldActive) {
  for (const bool power_off : {true, false}) {
    LineSettings supply = line("supply", LineUse::Stop, "UPS");
    supply.hold = std::chrono::milliseconds(10);
    supply.power_off = power_off;
    Lines lines({supply, line("ok", LineUse::ProcessOk, "UPS")});
    std::atomic<int> requests = 0;
    lines.on_stop_line([&](const std::string& name, bool powers_off) {
      EXPECT_EQ(name, "supply");
      EXPECT_EQ(powers_off, power_off);
      ++requests;
      requests.notify_all();
    });
    ASSERT_TRUE(lines.start());
    Status status;
    status.state = SystemState::Running;
    lines.accept(status);
    requests.wait(0);
    lines.stop();
    EXPECT_EQ(requests, 1);
  }
}

/// A camera that does not answer its trigger until the test permits it.
class SlowCamera : public hal::Camera {
 public:
  SlowCamera() : Camera({"slow", "slow", "test"}) {}

  Result<> trigger() override {
    ++asked;
    asked.notify_all();
    answers.wait(false);
    return {};
  }

  std::atomic<int> asked = 0;
  std::atomic<bool> answers = false;

 protected:
  Result<hal::StreamFormat> do_configure(const hal::StreamRequest&) override { return {}; }
  void run(const std::stop_token&) override {}
};

TEST(SlowTriggers, HoldUpNoLine) {
  SlowCamera camera;
  Lines lines({line("part", LineUse::TriggerIn, "PART"), line("start", LineUse::TriggerOut, "PART"),
               line("hears_ok", LineUse::ProcessInput, "OK"),
               line("ok", LineUse::ProcessOk, "OK")});
  const auto trigger = lines.trigger({.mode = hal::TriggerMode::Software}, "part", camera);
  ASSERT_TRUE(lines.start());
  ASSERT_EQ(lines.pulse(0), CommandResult::Done);
  camera.asked.wait(0);
  Status status;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  for (const SystemState state : {SystemState::Running, SystemState::Fault, SystemState::Running}) {
    status.state = state;
    lines.accept(status);
    const bool works = state == SystemState::Running;
    while (lines.process_inputs()[0]->active() != works && std::chrono::steady_clock::now() < end) {
      std::this_thread::yield();
    }
    EXPECT_EQ(lines.process_inputs()[0]->active(), works);
  }
  EXPECT_EQ(camera.asked, 1);
  camera.answers = true;
  camera.answers.notify_all();
  lines.stop();
  EXPECT_EQ(trigger->counts().waiting, 1U) << "for its frame";
}

}  // namespace
}  // namespace orbwatch::app
