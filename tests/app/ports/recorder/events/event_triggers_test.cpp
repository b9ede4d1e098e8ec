// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_triggers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/ports/recorder/events/event_summary.h"
#include "hal/lines/simulated_lines.h"
#include "hal/lines/watched_input.h"
#include "tests/app/ports/recorder/events/painted_event.h"
#include "tests/app/ports/recorder/events/read_event.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"
#include "tests/support/temporary_folder.h"

/// Events of a machine, by what triggers them.
namespace orbwatch::app::recorder {
namespace {

using std::chrono::milliseconds;
using tests::kThermal;
using tests::RecordedMachine;
using Numbers = std::vector<std::uint64_t>;

class Triggers : public testing::Test {
 protected:
  RecorderSettings settings() const {
    EventSettings events;
    events.ring_mib = 1;
    events.before = milliseconds(50);
    events.after = milliseconds(40);
    events.longest = milliseconds(300);
    events.on_laser = events.on_layer = true;
    events.on_lines = {"button"};
    return {.folder = folder_ / "recordings", .events = events};
  }

  const orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(Triggers, AnUnknownMachineStateIsNoEdge) {
  RecordedMachine machine(settings());
  machine.status.machine.values.laser_on = 1;
  machine.status.machine.values.layer = 3;
  for (std::uint64_t n = 1; n <= 5; ++n) machine.pass(n);
  machine.status.machine.values = {};
  for (std::uint64_t n = 6; n <= 10; ++n) machine.pass(n);
  machine.status.machine.values.laser_on = 1;
  machine.status.machine.values.layer = 3;
  for (std::uint64_t n = 11; n <= 30; ++n) machine.pass(n);
  machine.record_all();
  EXPECT_TRUE(machine.events().empty());
  machine.status.machine.values.layer = 4;
  for (std::uint64_t n = 31; n <= 50; ++n) machine.pass(n);
  machine.record_all();
  ASSERT_EQ(machine.events().size(), 1U);
  EXPECT_THAT(machine.events().front().name, testing::EndsWith("Z-layer"));
}

TEST_F(Triggers, AnInputThatBecomesActiveIsATriggerAlsoBetweenFrameSets) {
  hal::SimulatedLines lines{{"IN"}};
  hal::WatchedInput input(
      lines, {.address = {.name = "IN"}}, [](const auto&) {}, RecordedMachine::at(0));
  RecordedMachine machine(settings());
  const auto pass = [&](std::uint64_t n) {
    input.read(RecordedMachine::at(n));
    machine.status.process_input_edges[RecordedMachine::kButton] = input.state()->edges();
    machine.pass(n);
  };
  const auto pulse = [&](std::uint64_t n) {
    for (const bool level : {true, false}) lines.drive("IN", level, RecordedMachine::at(n));
  };
  pulse(0);
  for (std::uint64_t n = 1; n <= 20; ++n) pass(n);
  EXPECT_EQ(machine.statistics().triggers_joined, 0U) << "before the first frame set";
  for (int count = 0; count < 3; ++count) pulse(20);
  machine.status.process_input_edges[0] = 7;  // the other line
  for (std::uint64_t n = 21; n <= 40; ++n) pass(n);
  machine.record_all();
  const auto events = machine.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(machine.statistics().triggers_joined, 2U);
  EXPECT_THAT(events.front().name, testing::EndsWith("Z-line"));
  const auto summary = read_summary(events.front().folder);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_EQ(summary->trigger, "line");
  EXPECT_EQ(summary->text, "line button became active");
  EXPECT_EQ(summary->line, "button");
  EXPECT_FALSE(summary->alarm);
  EXPECT_EQ(summary->frame_set, 21U);
}

/// Two frame sets 10 s apart, as of slow triggers; between them and afterwards statuses that repeat
/// the stamp, ten times a second. At 6 s comes the cause, which ends at 7 s.
void pass_slow_sets(RecordedMachine& machine, TriggerKind kind) {
  auto& laser = machine.status.machine.values.laser_on;
  auto& layer = machine.status.machine.values.layer;
  laser = 0;
  layer = 1;
  for (std::uint64_t n = 1; n <= 2001; n += 10) {
    if (n == 601 && kind == TriggerKind::Command) machine.recorder().request();
    if (n == 601 && kind == TriggerKind::Line)
      ++machine.status.process_input_edges[RecordedMachine::kButton];
    if (n == 601 && kind == TriggerKind::Layer) layer = 2;
    if (kind == TriggerKind::Laser) laser = n >= 601 && n < 701 ? 1 : 0;
    if (n == 1 || n == 1001) {
      machine.pass(n);
    } else {
      machine.idle(RecordedMachine::at(n));
    }
  }
}

TEST_F(Triggers, ATriggerBetweenTwoFrameSetsBelongsToTheNextOne) {
  for (const TriggerKind kind :
       {TriggerKind::Command, TriggerKind::Line, TriggerKind::Laser, TriggerKind::Layer}) {
    SCOPED_TRACE(name_of(kind));
    RecorderSettings site = settings();
    site.folder = folder_ / std::string(name_of(kind));
    site.events->before = site.events->after = std::chrono::seconds(5);
    site.events->longest = std::chrono::seconds(60);
    RecordedMachine machine(site);
    pass_slow_sets(machine, kind);
    machine.record_all();
    const auto events = machine.events();
    ASSERT_EQ(events.size(), 1U);
    const auto summary = read_summary(events.front().folder);
    ASSERT_TRUE(summary) << summary.error().message;
    EXPECT_EQ(summary->trigger, name_of(kind));
    EXPECT_EQ(summary->frame_set, 1001U);
    auto topics = tests::read_recording(events.front().folder / kEventFile);
    EXPECT_EQ(tests::sequences_of(topics[kThermal]), Numbers{1001});
  }
}

TEST_F(Triggers, WithoutFurtherFrameSetsATriggerKeepsTheNewestPictures) {
  using std::chrono::seconds;
  // The cause comes soon after the frame set, or after more than the longest time of an event.
  for (const seconds quiet : {seconds(1), seconds(100)}) {
    SCOPED_TRACE(quiet.count());
    RecorderSettings site = settings();
    site.folder = folder_ / std::to_string(quiet.count());
    site.events->before = site.events->after = seconds(5);
    site.events->longest = seconds(60);
    RecordedMachine machine(site);
    machine.pass(1);
    const hal::TimePoint cause = RecordedMachine::at(1) + quiet;
    machine.idle(cause - milliseconds(100));
    machine.recorder().request();
    machine.idle(cause);
    machine.idle(cause + site.events->after);
    machine.record_all();
    EXPECT_TRUE(machine.events().empty()) << "the next frame set may come yet";
    machine.idle(cause + site.events->after + milliseconds(1));
    machine.idle(cause + seconds(20));
    machine.record_all();
    const auto events = machine.events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_TRUE(events.front().is_finished);
    auto topics = tests::read_recording(events.front().folder / kEventFile);
    EXPECT_EQ(tests::sequences_of(topics[kThermal]), Numbers{1});
  }
}

TEST_F(Triggers, WithoutFurtherFrameSetsATriggerWaitsTwoSecondsAtLeast) {
  RecordedMachine machine(settings());  // after_s is 40 ms
  machine.pass(1);
  machine.recorder().request();
  const hal::TimePoint cause = RecordedMachine::at(1) + milliseconds(5);
  machine.idle(cause);
  machine.idle(cause + std::chrono::seconds(2));
  machine.pass(300);
  for (std::uint64_t n = 301; n <= 310; ++n) machine.pass(n);
  machine.record_all();
  const auto events = machine.events();
  ASSERT_EQ(events.size(), 1U);
  const auto summary = read_summary(events.front().folder);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_EQ(summary->frame_set, 300U);
}

TEST_F(Triggers, ThoseThatWaitAtTheEndKeepTheNewestPictures) {
  RecordedMachine machine(settings());
  machine.recorder().request();
  machine.recorder().fire_waiting();
  machine.record_all();
  EXPECT_TRUE(machine.events().empty()) << "there is no frame set";
  for (std::uint64_t n = 1; n <= 20; ++n) machine.pass(n);
  machine.record_all();
  ASSERT_EQ(machine.events().size(), 1U);
  machine.recorder().request();
  ++machine.status.process_input_edges[RecordedMachine::kButton];
  machine.idle(RecordedMachine::at(20) + milliseconds(1));
  machine.recorder().fire_waiting();
  machine.record_all();
  ASSERT_TRUE(machine.recorder().end());
  const auto events = machine.events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(machine.statistics().triggers_joined, 1U);
  const auto summary = read_summary(events.back().folder);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_EQ(summary->frame_set, 20U);
  auto topics = tests::read_recording(events.back().folder / kEventFile);
  EXPECT_EQ(tests::sequences_of(topics[kThermal]).back(), 20U);
}

}  // namespace
}  // namespace orbwatch::app::recorder
