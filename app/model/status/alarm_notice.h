// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/model/command/giver.h"
#include "app/model/status/readings.h"
#include "app/model/status/status_report.h"

namespace orbwatch::app {

/// One event of an alarm, with its circumstances.
struct AlarmNotice {
  std::uint64_t number = 0;  ///< counts notices from 1
  signals::AlarmEvent event;
  std::size_t region = 0;
  SignalNumber signal{};
  std::uint16_t recipe = 0;
  std::uint64_t frame_set = 0;  ///< the newest one at that time
  /// Exposure start of that frame set; the time of the event if there is none.
  hal::TimePoint stamp{};
  Giver by{};                         ///< origin of an acknowledgement
  PartName part{};                    ///< that the machine made at that time; empty: not known
  double layer = signals::kNotValid;  ///< of it
};

// All reentrant.

/// The alarm after the event, as far as the notice has its fields.
AlarmStatus alarm_after(const AlarmNotice& notice);

/// Name of the alarm's component in the status: "5, edge: hot_spot_width".
std::string alarm_name(const AlarmNotice& notice, const StatusNames& names);

/// The event in one line: "weld: hot_spot_width raised, high alarm, 3.2 mm".
std::string event_text(const AlarmNotice& notice, const StatusNames& names);

/// alarm, event, state, level, value, signal, region, recipe, frame_set, part, layer; more may be
/// appended. Their texts are valid as long as `notice` and `names`.
std::vector<Reading> notice_readings(const AlarmNotice& notice, const StatusNames& names);

}  // namespace orbwatch::app
