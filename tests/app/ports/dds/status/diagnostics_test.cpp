// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/diagnostics.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app::dds {
namespace {

class Diagnostics : public testing::Test {
 protected:
  Diagnostics() {
    for (std::size_t i = 0; i < status_.camera_count; ++i) {
      status_.cameras[i].last_frame = now_ - std::chrono::milliseconds(250);
      status_.cameras[i].fault = hal::Fault::None;
    }
    status_.recipe_refused = false;
    network_.commands = {1, 2, 3, 4};
  }

  std::vector<Diagnostic> all() const { return diagnose({status_, names_, now_, {}}, network_); }
  Diagnostic found(const std::string& name) const {
    for (const Diagnostic& diagnostic : all()) {
      if (diagnostic.name == name) return diagnostic;
    }
    ADD_FAILURE() << "no diagnostic " << name;
    return {};
  }
  DiagnosticLevel level(const std::string& name) const { return found(name).level; }

  static std::string value(const Diagnostic& diagnostic, const std::string& key) {
    for (const auto& [name, text] : diagnostic.values) {
      if (name == key) return text;
    }
    ADD_FAILURE() << diagnostic.name << " has no " << key;
    return {};
  }

  Status status_ = tests::make_status();
  StatusNames names_ = tests::make_names();
  hal::TimePoint now_ = hal::Clock::now();
  DdsStatistics network_;
};

TEST_F(Diagnostics, NameEveryPartOnce) {
  std::set<std::string> names;
  for (const Diagnostic& diagnostic : all()) {
    EXPECT_TRUE(names.insert(diagnostic.name).second) << diagnostic.name;
    EXPECT_FALSE(diagnostic.message.empty()) << diagnostic.name;
    if (diagnostic.name == "orbwatch: network") continue;  // nothing to report
    EXPECT_FALSE(diagnostic.values.empty()) << diagnostic.name;
  }
  const std::string first(signals::kSignals[0].name), second(signals::kSignals[1].name),
      third(signals::kSignals[2].name);
  EXPECT_EQ(names, (std::set<std::string>{
                       "orbwatch: system", "orbwatch: camera colour", "orbwatch: camera thermal",
                       "orbwatch: view front", "orbwatch: view wide", "orbwatch: region weld",
                       "orbwatch: region edge", "orbwatch: alarm 1, weld: " + first,
                       "orbwatch: alarm 2, edge: " + second, "orbwatch: alarm 3, weld: " + third,
                       "orbwatch: health", "orbwatch: commands", "orbwatch: network",
                       "orbwatch: stage capture", "orbwatch: stage halving",
                       "orbwatch: stage views", "orbwatch: stage measurement",
                       "orbwatch: stage publication", "orbwatch: stage sinks"}));
}

TEST_F(Diagnostics, WhatHasNoNameHasItsNumber) {
  names_ = {};
  EXPECT_EQ(found("orbwatch: camera 2").message, "camera delivers");
  EXPECT_EQ(found("orbwatch: region 1").message, operator_text(Quality::Apparent));
}

TEST_F(Diagnostics, SystemIsAsBadAsItsState) {
  const std::array levels{DiagnosticLevel::Stale, DiagnosticLevel::Ok, DiagnosticLevel::Warn,
                          DiagnosticLevel::Error, DiagnosticLevel::Ok};
  for (std::size_t state = 0; state < levels.size(); ++state) {
    status_.state = static_cast<SystemState>(state);
    const Diagnostic system = found("orbwatch: system");
    EXPECT_EQ(system.level, levels[state]);
    EXPECT_EQ(system.message, operator_text(status_.state));
    EXPECT_EQ(value(system, "state"), operator_text(status_.state));
  }
  status_.state = SystemState::Running;
  status_.recipe_refused = true;
  EXPECT_EQ(level("orbwatch: system"), DiagnosticLevel::Warn);
  EXPECT_EQ(value(found("orbwatch: system"), "recipe_refused"), "True");
  status_.state = SystemState::Fault;
  EXPECT_EQ(level("orbwatch: system"), DiagnosticLevel::Error);
}

TEST_F(Diagnostics, CameraTellsItsFaultAndItsFigures) {
  EXPECT_EQ(level("orbwatch: camera colour"), DiagnosticLevel::Ok);
  status_.cameras[0].last_frame = {};
  EXPECT_EQ(level("orbwatch: camera colour"), DiagnosticLevel::Stale);
  status_.cameras[0].fault = hal::Fault::Unplugged;
  const Diagnostic camera = found("orbwatch: camera colour");
  EXPECT_EQ(camera.level, DiagnosticLevel::Error);
  EXPECT_EQ(camera.message, "camera is not connected, or cannot be opened");
  EXPECT_EQ(value(camera, "dropped"), std::to_string(status_.cameras[0].dropped));
  EXPECT_EQ(value(camera, "last_frame_age (s)"), "not valid");
  EXPECT_EQ(level("orbwatch: camera thermal"), DiagnosticLevel::Ok);
}

TEST_F(Diagnostics, CameraTellsThatItMovedOrItsBallIsDirty) {
  status_.cameras[0].alignment = AlignmentLevel::Warning;
  EXPECT_EQ(level("orbwatch: camera colour"), DiagnosticLevel::Warn);
  status_.cameras[0].cleanliness = WatchLevel::Alarm;
  const Diagnostic camera = found("orbwatch: camera colour");
  EXPECT_EQ(camera.level, DiagnosticLevel::Error);
  EXPECT_EQ(camera.message,
            "camera delivers; its alignment is beyond its warning limit; its ball's dirt is beyond "
            "its alarm limit");
}

TEST_F(Diagnostics, CameraTellsThatItsOutlineIsWrongAlthoughNothingMoved) {
  status_.cameras[0].fault = hal::Fault::None;
  status_.cameras[0].alignment = AlignmentLevel::Good;
  status_.cameras[0].outline_check = OutlineState::NotAligned;
  const Diagnostic camera = found("orbwatch: camera colour");
  EXPECT_EQ(camera.level, DiagnosticLevel::Warn);
  EXPECT_EQ(camera.message,
            "camera delivers; its outline is not aligned with the ball that is found");
  status_.cameras[0].outline_check = OutlineState::Unknown;
  EXPECT_EQ(level("orbwatch: camera colour"), DiagnosticLevel::Ok);
}

TEST_F(Diagnostics, ViewAndRegionAreStaleBeforeTheyGiveAnything) {
  EXPECT_EQ(level("orbwatch: view front"), DiagnosticLevel::Ok);
  EXPECT_EQ(value(found("orbwatch: view front"), "skipped"),
            std::to_string(status_.views[0].skipped));
  status_.views[0].published = 0;
  EXPECT_EQ(level("orbwatch: view front"), DiagnosticLevel::Stale);
  EXPECT_EQ(level("orbwatch: region weld"), DiagnosticLevel::Ok);
  status_.regions[0].quality = Quality::NotMeasured;
  EXPECT_EQ(level("orbwatch: region weld"), DiagnosticLevel::Stale);
}

TEST_F(Diagnostics, AlarmIsAsBadAsItStands) {
  using signals::AlarmLevel;
  using signals::AlarmState;
  struct Case {
    AlarmState state;
    AlarmLevel level, announced;
    DiagnosticLevel expected;
  };
  for (const Case& c : {
           Case{AlarmState::Normal, AlarmLevel::None, AlarmLevel::None, DiagnosticLevel::Ok},
           Case{AlarmState::Unacknowledged, AlarmLevel::HighWarning, AlarmLevel::HighWarning,
                DiagnosticLevel::Warn},
           Case{AlarmState::Unacknowledged, AlarmLevel::LowAlarm, AlarmLevel::LowAlarm,
                DiagnosticLevel::Error},
           Case{AlarmState::Acknowledged, AlarmLevel::HighAlarm, AlarmLevel::None,
                DiagnosticLevel::Error},
           Case{AlarmState::Acknowledged, AlarmLevel::NoMeasurement, AlarmLevel::None,
                DiagnosticLevel::Warn},
           Case{AlarmState::ReturnedUnacknowledged, AlarmLevel::None, AlarmLevel::HighAlarm,
                DiagnosticLevel::Warn},
           Case{AlarmState::LatchedUnacknowledged, AlarmLevel::None, AlarmLevel::HighAlarm,
                DiagnosticLevel::Error},
           Case{AlarmState::SuppressedByDesign, AlarmLevel::HighAlarm, AlarmLevel::None,
                DiagnosticLevel::Ok},
       }) {
    status_.alarms[0].alarm = {c.state, c.level, c.announced, false};
    const Diagnostic alarm =
        found("orbwatch: alarm 1, weld: " + std::string(signals::kSignals[0].name));
    EXPECT_EQ(alarm.level, c.expected) << signals::operator_text(c.state);
    EXPECT_EQ(alarm.message, signals::operator_text(c.state));
  }
}

TEST_F(Diagnostics, BoardWarnsOfWhatIsWrongNow) {
  Health& health = status_.health;
  health.throttling = 0xf0;  // past causes only
  health.clock_synchronised = 1;
  EXPECT_EQ(level("orbwatch: health"), DiagnosticLevel::Ok);
  health.throttling = 0x01;
  EXPECT_EQ(level("orbwatch: health"), DiagnosticLevel::Warn);
  EXPECT_EQ(found("orbwatch: health").message,
            "under-voltage: the supply or its cable is too weak");
  health.throttling = 0x08;
  EXPECT_EQ(found("orbwatch: health").message,
            "the processors are throttled: too hot, or the supply is too weak");
  health.throttling = 0x05;
  EXPECT_EQ(found("orbwatch: health").message,
            "under-voltage: the supply or its cable is too weak; the processors are throttled: too "
            "hot, or the supply is too weak");
  health.throttling = 0;
  health.clock_synchronised = 0;
  EXPECT_EQ(found("orbwatch: health").message, "the clock follows no time server");
  health.commands_recorded = 0;
  EXPECT_EQ(found("orbwatch: health").message,
            "the clock follows no time server; commands are not recorded: see state_folder");
  health = {};
  EXPECT_EQ(level("orbwatch: health"), DiagnosticLevel::Stale);
  health.disk_free = 7;
  EXPECT_EQ(level("orbwatch: health"), DiagnosticLevel::Ok);
}

TEST_F(Diagnostics, KeysAreTheListsNamesWithTheirUnits) {
  status_.health.board_temperature = 51.25;
  status_.health.throttling = signals::kNotValid;
  const Diagnostic board = found("orbwatch: health");
  ASSERT_EQ(board.values.size(), kHealthFigures.size());
  for (std::size_t i = 0; i < kHealthFigures.size(); ++i) {
    EXPECT_TRUE(board.values[i].first.starts_with(kHealthFigures[i].name));
  }
  EXPECT_EQ(value(board, "board_temperature (degC)"), "51.25");
  EXPECT_EQ(value(board, "throttling"), "not valid");
  const Diagnostic commands = found("orbwatch: commands");
  EXPECT_EQ(value(commands, "done") + value(commands, "refused") + value(commands, "repeated") +
                value(commands, "dropped"),
            "1234");
}

TEST_F(Diagnostics, TheMessageHoldsThemAll) {
  DiagnosticsComposer composer("cell-7");
  for (const std::size_t count : {12U, 1U, 5U}) {  // memory is reused
    auto diagnostics = all();
    diagnostics.resize(count);
    const DiagnosticsMessage& message = composer.compose(diagnostics, {17, 18});
    EXPECT_EQ(message.header.stamp.sec, 17);
    EXPECT_STREQ(message.header.frame_id, "");
    ASSERT_EQ(message.status._length, count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& entry = message.status._buffer[i];
      EXPECT_EQ(entry.level, static_cast<std::uint8_t>(diagnostics[i].level));
      EXPECT_EQ(entry.name, diagnostics[i].name);
      EXPECT_EQ(entry.message, diagnostics[i].message);
      EXPECT_STREQ(entry.hardware_id, "cell-7");
      ASSERT_EQ(entry.values._length, diagnostics[i].values.size());
      for (std::size_t v = 0; v < diagnostics[i].values.size(); ++v) {
        EXPECT_EQ(entry.values._buffer[v].key, diagnostics[i].values[v].first);
        EXPECT_EQ(entry.values._buffer[v].value, diagnostics[i].values[v].second);
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::app::dds
