// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/condition.h"
#include "app/ports/modbus/map/bits.h"
#include "app/ports/modbus/map/block.h"
#include "app/ports/modbus/map/rows.h"

namespace orbwatch::app::modbus {
namespace {

static_assert(kHealth.end <= kMaxReadRegisters, "one request reads what each scan needs");
static_assert(registers_of<ResultQueueStatus>() <= kResultQueue.size());
static_assert(registers_of<SystemStatus>() <= kSystem.size());
static_assert(registers_of<Health>() <= kHealth.size());
static_assert(registers_of<PlcStatus>() <= kPlc.size());
static_assert(registers_of<ServerStatus>() <= kServer.size());
static_assert(registers_of<CameraStatus>() <= kCameras.stride);
static_assert(registers_of<ViewStatus>() <= kViews.stride);
static_assert(registers_of<AlarmStatus>() <= kAlarms.stride);
static_assert(registers_of<StageStatus>() <= kStageParts.stride);
static_assert(registers_of<MachineStatus>() <= kMachine.size() &&
              kResultMachine.size() == kMachine.size());
static_assert(kCameras.has_room_for(kMaxCameras) && kViews.has_room_for(kMaxViews) &&
              kStageParts.has_room_for(kStages) && kAlarms.has_room_for(signals::kMaxAlarms));
static_assert(signals::kMaxAlarms <= 32,
              "bits of a UDINT; the next 32 alarms get another UDINT beside each of these");

/// Stride of the words of alarms 1 to 32, with room for those of alarms 33 to 64.
constexpr int kWordStride = 4;

/// Adds rows that combine several parts, or belong to this interface only.
void add_summary(std::vector<Row>& rows) {
  using I = const ProcessImage&;
  Block<ProcessImage> block(rows, Table::Input, kSummary, "", whole_image);
  const auto word = [&block](std::string_view name, std::string_view description,
                             const std::vector<Bit>& bits) {
    block.row(Type::Udint, name, kDoubleWord, std::string(description),
              [bits](I, I image) { return word_of(bits, image); });
  };
  const auto count = [&block](std::string_view name, std::size_t maximum,
                              std::string_view description, std::size_t Status::*member) {
    block.row(Type::Uint, name, {"", 1, 0, static_cast<double>(maximum)}, std::string(description),
              [member](I, I image) { return image.live.status.*member; });
  };
  block
      .row(Type::Uint, "map_version", {"", 1, 1, 65535},
           "Version of this map; grows with every change that an existing PLC program could notice",
           [](I, I) { return kMapVersion; })
      .row(Type::Uint, "alarm_severity", code_range<Severity>(),
           "Severity of the worst active alarm: " + listed_codes<Severity>(),
           [](I, I image) { return static_cast<int>(worst_severity(image.live.status)); });
  word("status_bits", "Bit n is discrete input n, bit 0 the lowest", status_bits());
  word("measurement_bits", "Bit n is discrete input 32 + n", measurement_bits());
  word("fault_bits", "Present faults, see the fault bits; 0: none", fault_bits());
  block
      .row(Type::Udint, "utc_seconds", {"s", 1, 0, 4294967295},
           "UTC of the newest frame set's exposure start, seconds since 1970; 0: none yet",
           [](I, I image) { return image.live.utc.count() / 1000000; })
      .row(Type::Udint, "utc_microseconds", {"us", 1, 0, 999999}, "Microseconds in that second",
           [](I, I image) { return image.live.utc.count() % 1000000; });
  count("region_count", signals::kMaxRegions, "Regions of the recipe", &Status::region_count);
  count("camera_count", kMaxCameras, "Configured cameras", &Status::camera_count);
  count("view_count", kMaxViews, "Configured views", &Status::view_count);
  count("alarm_count", signals::kMaxAlarms, "Alarms of the recipe", &Status::alarm_count);
}

/// Bit n: alarm n + 1 satisfies `holds`.
template <class Holds>
std::uint32_t alarm_word(const Status& status, Holds holds) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < status.alarm_count; ++i) {
    if (holds(status.alarms[i])) word |= 1U << i;
  }
  return word;
}

void add_alarm_summary(std::vector<Row>& rows) {
  using I = const ProcessImage&;
  Block<ProcessImage> block(rows, Table::Input, kAlarmSummary, "alarms_", whole_image);
  block.row(Type::Udint, "active", kDoubleWord,
            "Bit n is discrete input 128 + n: alarm n + 1 is active",
            [bits = active_bits()](I, I image) { return word_of(bits, image); });
  block.at(kAlarmSummary.begin + kWordStride)
      .row(Type::Udint, "unacknowledged", kDoubleWord,
           "Bit n is discrete input 192 + n: alarm n + 1 awaits its acknowledgement",
           [bits = unacknowledged_bits()](I, I image) { return word_of(bits, image); });
  block.at(kAlarmSummary.begin + 2 * kWordStride)
      .row(Type::Udint, "severe", kDoubleWord, "Bit n: alarm n + 1 is active at an alarm level",
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
}

/// Adds the rows of a single part.
template <class Part>
void add_part(std::vector<Row>& rows, Section section, const std::string& prefix,
              typename Block<Part>::Find find) {
  Block<Part>(rows, Table::Input, section, prefix, std::move(find)).fields();
}

/// Adds the rows of each part of a list, numbered from `first`. Parts beyond `count`, if it is set,
/// are not configured.
template <class Part, std::size_t size>
void add_parts(std::vector<Row>& rows, const Series& series, const std::string& name,
               std::size_t first, std::array<Part, size> Status::*parts,
               std::size_t Status::*count = nullptr) {
  using I = const ProcessImage&;
  for (std::size_t i = 0; i < size; ++i) {
    Block<Part> block(rows, Table::Input, series.entry(i),
                      name + "_" + std::to_string(first + i) + "_",
                      [i, parts](I p) -> const Part& { return (p.live.status.*parts)[i]; });
    block.fields();
    if (count) block.absent(name, [i, count](I p) { return i >= p.live.status.*count; });
  }
}

}  // namespace

void add_status_rows(std::vector<Row>& rows) {
  using I = const ProcessImage&;
  add_summary(rows);
  add_part<ResultQueueStatus>(
      rows, kResultQueue, "result_", [](I p) -> auto& { return p.results; });
  add_part<SystemStatus>(
      rows, kSystem, "system_", [](I p) -> auto& { return p.live.status; });
  add_part<Health>(
      rows, kHealth, "health_", [](I p) -> auto& { return p.live.status.health; });
  add_part<PlcStatus>(
      rows, kPlc, "plc_", [](I p) -> auto& { return p.plc; });
  add_part<ServerStatus>(
      rows, kServer, "modbus_", [](I p) -> auto& { return p.server; });
  for (std::size_t i = 0; i < kStages; ++i) {
    add_part<StageStatus>(
        rows, kStageParts.entry(i),
        "stage_" + std::string(name_of(static_cast<Stage>(i))) + "_", [i](I p) -> auto& {
          return p.live.status.stages[i];
        });
  }
  add_part<MachineStatus>(
      rows, kMachine, "machine_", [](I p) -> auto& { return p.live.status.machine; });
  add_part<MachineStatus>(
      rows, kResultMachine, "result_machine_",
      [](I p) -> auto& { return p.result.status.machine; });
  add_parts(rows, kCameras, "camera", 0, &Status::cameras, &Status::camera_count);
  add_parts(rows, kViews, "view", 0, &Status::views);
  add_alarm_summary(rows);
  add_parts(rows, kAlarms, "alarm", 1, &Status::alarms, &Status::alarm_count);
}

void add_discrete_rows(std::vector<Row>& rows) {
  Block<ProcessImage> all(rows, Table::Discrete, {kStatusBits.begin, kUnacknowledgedBits.end}, "",
                          whole_image);
  const auto append = [&all](const std::vector<Bit>& bits, Section section) {
    for (std::size_t n = 0; n < bits.size(); ++n) {
      if (!bits[n].is_set) continue;
      all.at(section.begin + static_cast<int>(n));
      all.bit(bits[n].name, bits[n].description, bits[n].is_set);
    }
  };
  append(status_bits(), kStatusBits);
  append(measurement_bits(), kMeasurementBits);
  append(process_input_bits(), kProcessInputBits);
  append(active_bits(), kActiveBits);
  append(unacknowledged_bits(), kUnacknowledgedBits);
}

}  // namespace orbwatch::app::modbus
