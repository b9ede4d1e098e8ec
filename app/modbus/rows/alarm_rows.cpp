#include <algorithm>

#include "app/modbus/alarm_summary.h"
#include "app/modbus/bits.h"
#include "app/modbus/codes.h"
#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {
namespace {

constexpr int kMaxAlarms = signals::kMaxAlarms;

static_assert(kFirstAlarm + kMaxAlarms * kAlarmStride <= kLiveBlock);

using S = const Snapshot&;

/// Bit n: alarm n + 1 satisfies `holds`.
template <class Holds>
std::uint32_t alarm_word(const Status& status, Holds holds) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < status.alarm_count; ++i) {
    if (holds(status.alarms[i])) word |= 1U << i;
  }
  return word;
}

std::vector<Row> summary_rows() {
  Block<Snapshot> block(Table::Input, kAlarmBlock, "", whole_snapshot);
  block
      .u16("alarm_count", {1, "", 0, kMaxAlarms}, "Alarms that the recipe has",
           [](S s) { return s.live.status.alarm_count; })
      .u16("alarm_severity", range_of(severity_codes()),
           "The worst that stands: " + listed(severity_codes()),
           [](S s) { return worst_severity(s.live.status); })
      .u32("alarms_active", kCounter, "Bit n is discrete input 64 + n: alarm n + 1 stands",
           [](S s) { return word_of(active_bits(), s); })
      .u32("alarms_unacknowledged", kCounter,
           "Bit n is discrete input 96 + n: alarm n + 1 awaits its acknowledgement",
           [](S s) { return word_of(unacknowledged_bits(), s); })
      .u32("alarms_severe", kCounter, "Bit n: alarm n + 1 stands at an alarm level",
           [](S s) {
             return alarm_word(s.live.status,
                               [](const AlarmStatus& a) { return standing_severity(a) == 2; });
           })
      .u32("alarms_not_measured", kCounter, "Bit n: the signal of alarm n + 1 is not measured",
           [](S s) {
             return alarm_word(s.live.status,
                               [](const AlarmStatus& a) { return a.alarm.measurement_lost; });
           });
  return block.reserved_to(kFirstAlarm).rows();
}

std::uint32_t value_code(const AlarmStatus& alarm) {
  return scaled(alarm.value, quantity_of(signals::kSignals[alarm.signal]));
}

std::chrono::milliseconds state_age(const AlarmStatus& alarm, const Snapshot& snapshot) {
  using std::chrono::milliseconds;
  if (alarm.since == hal::TimePoint{}) return milliseconds::max();
  return std::chrono::duration_cast<milliseconds>(snapshot.now - alarm.since);
}

std::vector<Row> rows_of_alarm(std::size_t index) {
  const int base = kFirstAlarm + static_cast<int>(index) * kAlarmStride;
  Block<AlarmStatus> block(
      Table::Input, base, "alarm_" + std::to_string(index + 1) + "_",
      [index](S s) -> const AlarmStatus& { return s.live.status.alarms[index]; });
  block
      .u16("state", range_of(alarm_state_codes()), listed(alarm_state_codes()),
           [index](const AlarmStatus& alarm, S s) {
             return index < s.live.status.alarm_count
                        ? static_cast<std::uint16_t>(alarm.alarm.state)
                        : kNone;
           })
      .u16("level", range_of(alarm_level_codes()),
           "Of its signal now: " + listed(alarm_level_codes()),
           [](const AlarmStatus& alarm) { return alarm.alarm.level; })
      .u16("region", {1, "", 0, signals::kMaxRegions - 1}, "Region that it watches, from 0",
           &AlarmStatus::region)
      .u16("signal", {1, "", 0, signals::kSignals.size() - 1},
           "Number of the signal that it watches, from 0 in the order of a region's signals",
           &AlarmStatus::signal)
      .i32("value", {1, "", -kMaxI32, kMaxI32},
           "Of that signal, in the signal's scale and unit; 0x80000000: not valid", value_code)
      .u32("age", kAge,
           "Since it has this state; stays at 2147483647, also when it never had another",
           state_age);
  return block.rows();
}

}  // namespace

std::vector<Row> alarm_rows() {
  std::vector<Row> rows = summary_rows();
  std::ranges::move(joined(signals::kMaxAlarms, rows_of_alarm), std::back_inserter(rows));
  const int end = kFirstAlarm + kMaxAlarms * kAlarmStride;
  std::ranges::move(
      Block<Snapshot>(Table::Input, end, "", whole_snapshot).reserved_to(kLiveBlock).rows(),
      std::back_inserter(rows));
  return rows;
}

}  // namespace orbwatch::app::modbus
