#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/model/giver.h"
#include "app/model/readings.h"
#include "app/model/status_report.h"

namespace orbwatch::app {

/// What happened to an alarm.
struct AlarmNotice {
  std::uint64_t number = 0;  ///< counts notices from 1
  signals::AlarmEvent event;
  std::size_t region = 0;
  SignalNumber signal{};
  std::uint16_t recipe = 0;
  std::uint64_t frame_set = 0;  ///< the newest one then
  hal::TimePoint stamp{};       ///< of that frame set, or of the moment without one
  Giver by{};                   ///< of an acknowledgement who gave it
};

// All reentrant.

/// The alarm after the event, as far as the notice says.
AlarmStatus alarm_after(const AlarmNotice& notice);

/// As a component of the status is named: "5, edge: hot_spot_width".
std::string alarm_name(const AlarmNotice& notice, const StatusNames& names);

/// In one line: "weld: hot_spot_width raised, high alarm, 3.2 mm".
std::string event_text(const AlarmNotice& notice, const StatusNames& names);

/// alarm, event, state, level, value, signal, region, recipe, frame_set; more may be appended.
/// Their texts are valid as long as `names`.
std::vector<Reading> notice_readings(const AlarmNotice& notice, const StatusNames& names);

}  // namespace orbwatch::app
