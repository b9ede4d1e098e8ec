#include <algorithm>
#include <iterator>

#include "app/model/condition.h"
#include "app/ports/modbus/map/bits.h"
#include "app/ports/modbus/map/block.h"
#include "app/ports/modbus/map/rows.h"

namespace orbwatch::app::modbus {
namespace {

static_assert(registers_of<AlarmStatus>() <= kAlarms.stride);
static_assert(kAlarms.has_room_for(signals::kMaxAlarms));
static_assert(signals::kMaxAlarms <= 32, "bits of a UDINT; the next 32 get one each beside them");

/// Places between the words of alarms 1 to 32: those of 33 to 64 fit in.
constexpr int kWordStride = 4;

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
  using I = const ProcessImage&;
  Block<ProcessImage> block(Table::Input, kAlarmSummary, "alarms_", whole_image);
  block.row(Type::Udint, "active", kDoubleWord,
            "Bit n is discrete input 128 + n: alarm n + 1 stands",
            [](I, I image) { return word_of(active_bits(), image); });
  block.at(kAlarmSummary.begin + kWordStride)
      .row(Type::Udint, "unacknowledged", kDoubleWord,
           "Bit n is discrete input 192 + n: alarm n + 1 awaits its acknowledgement",
           [](I, I image) { return word_of(unacknowledged_bits(), image); });
  block.at(kAlarmSummary.begin + 2 * kWordStride)
      .row(Type::Udint, "severe", kDoubleWord, "Bit n: alarm n + 1 stands at an alarm level",
           [](I, I image) {
             return alarm_word(image.live.status, [](const AlarmStatus& alarm) {
               return standing_severity(alarm) == Severity::Alarm;
             });
           });
  block.at(kAlarmSummary.begin + 3 * kWordStride)
      .row(Type::Udint, "not_measured", kDoubleWord,
           "Bit n: the signal of alarm n + 1 is not measured", [](I, I image) {
             return alarm_word(image.live.status, [](const AlarmStatus& alarm) {
               return alarm.alarm.measurement_lost;
             });
           });
  return std::move(block.rows());
}

std::vector<Row> rows_of_alarm(std::size_t i) {
  Block<AlarmStatus> block(
      Table::Input, kAlarms.entry(i), "alarm_" + std::to_string(i + 1) + "_",
      [i](const ProcessImage& p) -> const AlarmStatus& { return p.live.status.alarms[i]; });
  block.fields().absent("alarm",
                        [i](const ProcessImage& p) { return i >= p.live.status.alarm_count; });
  return std::move(block.rows());
}

}  // namespace

std::vector<Row> alarm_rows() {
  std::vector<Row> rows = summary_rows();
  std::ranges::move(joined(signals::kMaxAlarms, rows_of_alarm), std::back_inserter(rows));
  return rows;
}

}  // namespace orbwatch::app::modbus
