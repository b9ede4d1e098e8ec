// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/alarm_board.h"

#include <gmock/gmock.h>

#include <array>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tests/proc/signals/signal_index.h"

namespace orbwatch::signals {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = AlarmEventKind;
using Level = AlarmLevel;
using State = AlarmState;

static_assert(std::is_trivially_copyable_v<AlarmBoard>, "it owns no memory");

constexpr std::size_t kYaw = index_of("hot_spot_yaw");
constexpr std::size_t kArea = index_of("hot_spot_area");

AlarmLimits high(std::size_t signal, std::size_t region, double warning, double alarm) {
  AlarmLimits limits;
  limits.signal = signal;
  limits.region = region;
  limits.high_warning = warning;
  limits.high_alarm = alarm;
  limits.loss_delay = milliseconds(0);
  return limits;
}

struct Told {
  std::size_t alarm;
  Kind kind;
  State state;
  Level level;
  bool operator==(const Told&) const = default;
};

void PrintTo(const Told& told, std::ostream* out) {
  *out << told.alarm << " " << operator_text(told.kind) << ", " << operator_text(told.state) << ", "
       << operator_text(told.level);
}

/// Alarm 0 is the yaw of region 0, alarm 1 the area of region 1; warning at 10, alarm at 20.
struct TwoAlarms {
  std::vector<Told> step(double yaw, double area, AlarmSet acknowledged = {}, bool active = true) {
    regions[0].hot_spot_yaw = yaw;
    regions[1].hot_spot_area = area;
    now += milliseconds(100);
    std::vector<Told> told;
    for (const AlarmEvent& event : board.step({now, regions, active, acknowledged})) {
      told.push_back({event.alarm, event.kind, event.state, event.level});
      EXPECT_EQ(event.time, now);
      const double value = event.alarm == 0 ? yaw : area;
      EXPECT_TRUE(event.value == value || (!is_valid(event.value) && !is_valid(value)));
    }
    return told;
  }

  std::array<Signals, 2> regions;
  std::chrono::nanoseconds now{0};
  AlarmBoard board =
      AlarmBoard::make(std::array{high(kYaw, 0, 10, 20), high(kArea, 1, 10, 20)}, 2).value();
};

TEST(AlarmBoard, ReadsItsSignalInItsRegion) {
  TwoAlarms two;
  two.regions[0].hot_spot_area = two.regions[1].hot_spot_yaw = 100;
  EXPECT_THAT(two.step(0, 0), IsEmpty());
  EXPECT_THAT(two.step(15, 0),
              ElementsAre(Told{0, Kind::Raised, State::Unacknowledged, Level::HighWarning}));
  EXPECT_THAT(two.step(15, 25),
              ElementsAre(Told{1, Kind::Raised, State::Unacknowledged, Level::HighAlarm}));
  EXPECT_EQ(two.board.alarm(0).level, Level::HighWarning);
  EXPECT_EQ(two.board.alarm(1).level, Level::HighAlarm);
}

TEST(AlarmBoard, AcknowledgesOneOrAll) {
  TwoAlarms two;
  two.step(15, 15);
  EXPECT_THAT(two.step(15, 15, AlarmSet{0b10}),
              ElementsAre(Told{1, Kind::Acknowledged, State::Acknowledged, Level::HighWarning}));
  EXPECT_EQ(two.board.alarm(0).state, State::Unacknowledged);
  EXPECT_THAT(two.step(15, 15, AlarmSet{}.set()),
              ElementsAre(Told{0, Kind::Acknowledged, State::Acknowledged, Level::HighWarning}));
}

TEST(AlarmBoard, WhatRisesWithAnAcknowledgementWasNotSeenYet) {
  TwoAlarms two;
  two.step(15, 0);
  EXPECT_THAT(two.step(25, 0, AlarmSet{1}),
              ElementsAre(Told{0, Kind::Acknowledged, State::Acknowledged, Level::HighWarning},
                          Told{0, Kind::Raised, State::Unacknowledged, Level::HighAlarm}));
}

TEST(AlarmBoard, TellsEveryChange) {
  TwoAlarms two;
  two.step(25, 0);
  EXPECT_THAT(two.step(15, 0),
              ElementsAre(Told{0, Kind::Eased, State::Unacknowledged, Level::HighWarning}));
  EXPECT_THAT(two.step(0, 0),
              ElementsAre(Told{0, Kind::Cleared, State::ReturnedUnacknowledged, Level::HighAlarm}));
  EXPECT_THAT(two.step(0, 0), IsEmpty());
  EXPECT_THAT(two.step(0, 0, AlarmSet{1}),
              ElementsAre(Told{0, Kind::Acknowledged, State::Normal, Level::HighAlarm}));
  EXPECT_THAT(two.step(kNotValid, 0),
              ElementsAre(Told{0, Kind::Raised, State::Unacknowledged, Level::NoMeasurement}));
}

TEST(AlarmBoard, TellsWhatIsSuppressedButNotWhatWasNormal) {
  TwoAlarms two;
  two.step(25, 0);
  EXPECT_THAT(two.step(25, 0, {}, false),
              ElementsAre(Told{0, Kind::Suppressed, State::SuppressedByDesign, Level::HighAlarm}));
  EXPECT_THAT(two.step(25, 0, {}, false), IsEmpty());
  EXPECT_EQ(two.board.alarm(1).state, State::SuppressedByDesign);
  EXPECT_THAT(two.step(0, 0), IsEmpty());
}

TEST(AlarmBoard, ALatchedAlarmIsSuppressedOnce) {
  std::array limits{high(kYaw, 0, 10, 20)};
  limits[0].latching = true;
  auto board = AlarmBoard::make(limits, 1).value();
  std::array<Signals, 1> regions;
  regions[0].hot_spot_yaw = 25;
  board.step({milliseconds(0), regions, true, {}});
  const auto events = board.step({milliseconds(100), regions, false, {}});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, Kind::Suppressed);
  EXPECT_EQ(events[0].state, State::LatchedUnacknowledged);
  EXPECT_EQ(events[0].level, Level::HighAlarm);
  EXPECT_THAT(board.step({milliseconds(200), regions, false, {}}), IsEmpty());
}

TEST(AlarmBoard, ARegionThatIsNotThereIsNotMeasured) {
  TwoAlarms two;
  const auto events =
      two.board.step({milliseconds(100), std::span(two.regions).first(0), true, {}});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].level, Level::NoMeasurement);
  EXPECT_FALSE(is_valid(events[0].value));
}

TEST(AlarmBoard, HasRoomForEverythingAtOnce) {
  const std::vector<AlarmLimits> limits(kMaxAlarms, high(kYaw, 0, 10, 20));
  auto board = AlarmBoard::make(limits, 1).value();
  std::array<Signals, 1> regions;
  regions[0].hot_spot_yaw = 15;
  EXPECT_EQ(board.step({milliseconds(0), regions, true, {}}).size(), kMaxAlarms);
  regions[0].hot_spot_yaw = 25;
  const auto events = board.step({milliseconds(100), regions, true, AlarmSet{}.set()});
  ASSERT_EQ(events.size(), 2 * kMaxAlarms);
  EXPECT_EQ(events.back().alarm, kMaxAlarms - 1);
}

TEST(AlarmBoard, WithoutAlarmsIsSilent) {
  AlarmBoard board;
  EXPECT_THAT(board.step({milliseconds(0), {}, true, AlarmSet{}.set()}), IsEmpty());
}

TEST(AlarmBoard, NamesTheAlarmThatIsWrong) {
  const auto error = [](std::vector<AlarmLimits> limits, std::size_t regions) {
    const auto board = AlarmBoard::make(limits, regions);
    return board ? "none" : board.error().message;
  };
  const AlarmLimits good = high(kYaw, 0, 10, 20);
  EXPECT_EQ(error({good, high(kArea, 0, 20, 10)}, 1),
            "alarm 1 (hot_spot_area): high warning 20 is not below high alarm 10");
  EXPECT_EQ(error({good, high(kYaw, 2, 10, 20)}, 2),
            "alarm 1 (hot_spot_yaw): region 2 does not exist: there are 2");
  EXPECT_EQ(error(std::vector<AlarmLimits>(kMaxAlarms + 1, good), 1),
            "33 alarms are too many: at most 32");
  EXPECT_THAT(error({high(999, 0, 10, 20)}, 1), HasSubstr("alarm 0: signal 999 does not exist"));
}

}  // namespace
}  // namespace orbwatch::signals
