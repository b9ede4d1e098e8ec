#include "app/modbus/register_rows.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "app/modbus/codes.h"
#include "app/modbus/register_values.h"

namespace orbwatch::app::modbus {
namespace {

using S = const Snapshot&;
using Index = std::size_t;
using Read = std::uint32_t (*)(S, Index);

static_assert(signals::kSignals.size() <= kSignalSlots);
static_assert(kSignalBlock + kSignalSlots * kSignalStride <= 125, "one request reads both blocks");
static_assert(kCameraBlock + int{kMaxCameras} * kCameraStride <= kViewBlock);
static_assert(kViewBlock + int{kMaxViews} * kViewStride <= kMirrorOffset);
static_assert(std::ranges::all_of(signals::kSignals, [](const signals::SignalInfo& signal) {
  constexpr double kLimit = std::numeric_limits<std::int32_t>::max();
  return signal.minimum / signal.scale > -kLimit && signal.maximum / signal.scale < kLimit;
}));

/// Scale, unit and range of a row.
struct Quantity {
  double scale = 1;
  std::string_view unit;
  double minimum = 0;
  double maximum = 0;
};

constexpr double kMaxU16 = 65535;
constexpr double kMaxU32 = 4294967295;
constexpr double kMaxI32 = 2147483647;
constexpr Quantity kCounter{1, "", 0, kMaxU32};
constexpr Quantity kRate{0.01, "1/s", 0, 655.35};
constexpr Quantity kLatency{0.1, "ms", 0, 6553.5};

Quantity enumerated(const std::vector<Code>& codes) {
  return {1, "", 0, static_cast<double>(codes.back().number)};
}

int registers_of(Type type) { return type == Type::U32 || type == Type::I32 ? 2 : 1; }

Row input(int address, Type type, std::string name, Quantity quantity, std::string description,
          Read read, std::size_t index = 0) {
  return {.table = Table::Input,
          .address = address,
          .count = registers_of(type),
          .type = type,
          .name = std::move(name),
          .scale = quantity.scale,
          .unit = std::string(quantity.unit),
          .minimum = quantity.minimum,
          .maximum = quantity.maximum,
          .description = std::move(description),
          .index = index,
          .read = read};
}

Row reserved(Table table, int address, int end) {
  const bool bits = table == Table::Coil || table == Table::Discrete;
  return {.table = table,
          .address = address,
          .count = end - address,
          .type = bits ? Type::Bool : Type::U16,
          .name = "reserved_" + std::to_string(address),
          .description = "Reserved for growth; reads 0"};
}

Row discrete(int bit, std::string name, std::string description) {
  return {.table = Table::Discrete,
          .address = bit,
          .type = Type::Bool,
          .name = std::move(name),
          .maximum = 1,
          .description = std::move(description),
          .index = static_cast<std::size_t>(bit),
          .read = [](const Snapshot& snapshot, std::size_t index) {
            return status_bits(snapshot) >> index & 1U;
          }};
}

std::vector<Row> discrete_block() {
  std::vector<Row> rows{
      discrete(kRunning, "running", "Every camera delivers"),
      discrete(kDegraded, "degraded", "Some camera has a fault; what the others see is measured"),
      discrete(kFault, "fault", "No camera delivers, or the pipeline is silent"),
      discrete(kHotSpotPresent, "hot_spot_present", "The hot spot has an area above 0"),
      discrete(kStale, "stale",
               "The pipeline is silent: the state reads fault and no signal is valid"),
      reserved(Table::Discrete, kStale + 1, kFirstCamera),
  };
  for (int camera = 0; camera < int{kMaxCameras}; ++camera) {
    const std::string number = std::to_string(camera);
    rows.push_back(discrete(kFirstCamera + camera, "camera_" + number + "_delivers",
                            "Camera " + number + " is configured and has no fault"));
  }
  rows.push_back(reserved(Table::Discrete, kFirstCamera + int{kMaxCameras}, kStatusBits));
  return rows;
}

std::vector<Row> system_block() {
  constexpr int kBase = kSystemBlock;
  return {
      input(kBase + 0, Type::U16, "map_version", {1, "", 1, kMaxU16},
            "Version of this map; grows when an existing PLC program could notice a change",
            [](S, Index) { return std::uint32_t{kMapVersion}; }),
      input(kBase + 1, Type::U16, "heartbeat", {1, "", 0, kMaxU16},
            "Advances with the pipeline, at least ten times a second; goes on at 0 after 65535",
            [](S s, Index) { return low_word(s.status.heartbeat) & 0xffffU; }),
      input(kBase + 2, Type::U16, "system_state", enumerated(system_state_codes()),
            listed(system_state_codes()),
            [](S s, Index) { return static_cast<std::uint32_t>(s.status.state); }),
      input(kBase + 3, Type::U16, "status_bits", {1, "", 0, kMaxU16},
            "Bit n is discrete input n, bit 0 the lowest",
            [](S s, Index) { return status_bits(s); }),
      input(kBase + 4, Type::U16, "camera_count", {1, "", 0, double{kMaxCameras}},
            "Cameras that are configured",
            [](S s, Index) { return low_word(s.status.camera_count); }),
      input(kBase + 5, Type::U16, "view_count", {1, "", 0, double{kMaxViews}},
            "Views that are configured", [](S s, Index) { return low_word(s.status.view_count); }),
      input(kBase + 6, Type::U16, "selected_view", {1, "", 0, double{kMaxViews - 1}},
            "Index of the selected view, from 0",
            [](S s, Index) { return low_word(s.status.selected_view); }),
      input(kBase + 7, Type::U16, "load", {0.1, "%", 0, 6553.5},
            "Share of its deadline that the slowest frame set of the last second took",
            [](S s, Index) { return saturated(s.status.load * 100, 0.1); }),
      input(kBase + 8, Type::U32, "frame_set", kCounter,
            "Number of the newest frame set, which the signals belong to; 0: none yet",
            [](S s, Index) { return low_word(s.status.frame_set); }),
      input(kBase + 10, Type::U32, "frame_set_age", {1, "ms", 0, kMaxI32},
            "From the frame set's exposure start to this answer: the figure to supervise; "
            "stays at 2147483647, also when there is no frame set yet",
            [](S s, Index) { return age_code(s.age); }),
      input(
          kBase + 12, Type::U32, "frame_set_utc_seconds", {1, "s", 0, kMaxU32},
          "UTC of the frame set's exposure start, seconds since 1970; 0: none yet",
          [](S s, Index) { return low_word(static_cast<std::uint64_t>(s.utc.count()) / 1000000); }),
      input(
          kBase + 14, Type::U32, "frame_set_utc_microseconds", {1, "us", 0, 999999},
          "Microseconds within that second",
          [](S s, Index) { return low_word(static_cast<std::uint64_t>(s.utc.count()) % 1000000); }),
      input(kBase + 16, Type::U32, "overruns", kCounter,
            "Frame sets that took longer than their deadline",
            [](S s, Index) { return low_word(s.status.overruns); }),
      input(kBase + 18, Type::U32, "unmatched", kCounter,
            "Frame sets in which a camera had no frame within the window",
            [](S s, Index) { return low_word(s.status.unmatched); }),
      input(kBase + 20, Type::U32, "modbus_answered", kCounter,
            "Requests answered, with or without an exception",
            [](S s, Index) { return low_word(s.server.answered); }),
      input(kBase + 22, Type::U32, "modbus_refused", kCounter,
            "Requests answered with an exception, or not at all because they were not Modbus",
            [](S s, Index) { return low_word(s.server.refused); }),
      input(kBase + 24, Type::U32, "modbus_dropped", kCounter,
            "Connections the server ended: too many, too slow, or garbage",
            [](S s, Index) { return low_word(s.server.dropped); }),
      input(kBase + 26, Type::U16, "modbus_connections", {1, "", 0, kMaxU16},
            "Connections that are open now",
            [](S s, Index) { return low_word(s.server.connections); }),
      input(kBase + 27, Type::U16, "skew", kLatency,
            "Largest between the exposure starts of a frame set, of the last full second",
            [](S s, Index) { return saturated(s.status.skew_ms, 0.1); }),
      input(kBase + 28, Type::U32, "process_inputs", {1, "", 0, kMaxU32},
            "Bit n: the process input that is the configuration's nth is active",
            [](S s, Index) { return s.status.process_inputs; }),
      input(kBase + 30, Type::U32, "trigger", kCounter,
            "Number of the hardware trigger that began the newest frame set; 0: none did",
            [](S s, Index) { return low_word(s.status.trigger); }),
  };
}

std::uint32_t signal_value(const Snapshot& snapshot, std::size_t index) {
  const signals::SignalInfo& signal = signals::kSignals[index];
  return scaled(snapshot.status.signals.*signal.member, signal);
}

std::uint32_t signal_quality(const Snapshot& snapshot, std::size_t index) {
  return signal_value(snapshot, index) == kNotValidCode ? 0 : 1;
}

/// Value and quality side by side, padded to four registers: one ARRAY OF STRUCT in the PLC, no bit
/// operations, and a new signal moves none of the others.
std::vector<Row> signal_block() {
  std::vector<Row> rows;
  int address = kSignalBlock;
  for (std::size_t i = 0; i < signals::kSignals.size(); ++i, address += kSignalStride) {
    const signals::SignalInfo& signal = signals::kSignals[i];
    const std::string name(signal.name);
    rows.push_back(input(address, Type::I32, name,
                         {signal.scale, signal.unit, signal.minimum, signal.maximum},
                         std::string(signal.description), signal_value, i));
    rows.push_back(input(address + 2, Type::U16, name + "_quality", {1, "", 0, 1},
                         "1: the value is valid; 0: it is not and reads 0x80000000", signal_quality,
                         i));
    rows.push_back(reserved(Table::Input, address + 3, address + kSignalStride));
  }
  const int end = kSignalBlock + kSignalSlots * kSignalStride;
  if (address < end) rows.push_back(reserved(Table::Input, address, end));
  return rows;
}

std::uint32_t camera_fault(const Snapshot& snapshot, std::size_t camera) {
  if (camera >= snapshot.status.camera_count) return kNoCamera;
  return static_cast<std::uint32_t>(snapshot.status.cameras[camera].fault);
}

std::vector<Row> camera_block() {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    const int base = kCameraBlock + static_cast<int>(i) * kCameraStride;
    const std::string name = "camera_" + std::to_string(i);
    rows.push_back(input(base + 0, Type::U16, name + "_fault", enumerated(camera_fault_codes()),
                         listed(camera_fault_codes()), camera_fault, i));
    rows.push_back(input(
        base + 1, Type::U16, name + "_frames_per_second", kRate, "Over the last full second",
        [](S s, Index n) { return saturated(s.status.cameras[n].frames_per_second, 0.01); }, i));
    rows.push_back(input(
        base + 2, Type::U32, name + "_frames", kCounter, "Frames delivered since start",
        [](S s, Index n) { return low_word(s.status.cameras[n].frames); }, i));
    rows.push_back(input(
        base + 4, Type::U32, name + "_lost", kCounter, "Frames missing in the camera's sequence",
        [](S s, Index n) { return low_word(s.status.cameras[n].lost); }, i));
    rows.push_back(input(
        base + 6, Type::U32, name + "_dropped", kCounter,
        "Frames that a newer one replaced before they were used",
        [](S s, Index n) { return low_word(s.status.cameras[n].dropped); }, i));
    rows.push_back(input(
        base + 8, Type::U16, name + "_latency_p50", kLatency,
        "Exposure start to arrival, median of the last full second",
        [](S s, Index n) { return saturated(s.status.cameras[n].latency_p50_ms, 0.1); }, i));
    rows.push_back(input(
        base + 9, Type::U16, name + "_latency_p99", kLatency,
        "Exposure start to arrival, 99 of 100 are faster",
        [](S s, Index n) { return saturated(s.status.cameras[n].latency_p99_ms, 0.1); }, i));
    rows.push_back(input(
        base + 10, Type::U32, name + "_triggers", kCounter, "Edges of its trigger line since start",
        [](S s, Index n) { return low_word(s.status.cameras[n].triggers); }, i));
    rows.push_back(input(
        base + 12, Type::U32, name + "_missed", kCounter,
        "Triggers without a frame: faster than the camera, or its fault",
        [](S s, Index n) { return low_word(s.status.cameras[n].missed); }, i));
    rows.push_back(input(
        base + 14, Type::U32, name + "_unmatched", kCounter,
        "Frames delivered while the pacing camera had none of that moment",
        [](S s, Index n) { return low_word(s.status.cameras[n].unmatched); }, i));
  }
  return rows;
}

std::vector<Row> view_block() {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < kMaxViews; ++i) {
    const int base = kViewBlock + static_cast<int>(i) * kViewStride;
    const std::string name = "view_" + std::to_string(i);
    rows.push_back(input(
        base + 0, Type::U32, name + "_published", kCounter, "Views published since start",
        [](S s, Index n) { return low_word(s.status.views[n].published); }, i));
    rows.push_back(input(
        base + 2, Type::U32, name + "_skipped", kCounter,
        "Frame sets without this view: display slowed down, or no buffer",
        [](S s, Index n) { return low_word(s.status.views[n].skipped); }, i));
    rows.push_back(input(
        base + 4, Type::U16, name + "_frames_per_second", kRate, "Over the last full second",
        [](S s, Index n) { return saturated(s.status.views[n].frames_per_second, 0.01); }, i));
    rows.push_back(input(
        base + 5, Type::U16, name + "_latency_p50", kLatency,
        "Exposure start to hand-over, median of the last full second",
        [](S s, Index n) { return saturated(s.status.views[n].latency_p50_ms, 0.1); }, i));
    rows.push_back(input(
        base + 6, Type::U16, name + "_latency_p99", kLatency,
        "Exposure start to hand-over, 99 of 100 are faster",
        [](S s, Index n) { return saturated(s.status.views[n].latency_p99_ms, 0.1); }, i));
    rows.push_back(reserved(Table::Input, base + 7, base + kViewStride));
  }
  return rows;
}

Row holding(int address, Type type, std::string name, Quantity quantity, std::string description,
            Read read, void (*write)(CommandRegisters&, std::uint32_t) = nullptr) {
  Row row = input(address, type, std::move(name), quantity, std::move(description), read);
  row.table = Table::Holding;
  row.access = write ? Access::ReadWrite : Access::Read;
  row.write = write;
  return row;
}

/// The sequence stands last of what is written: a PLC that writes register by register in ascending
/// order starts the command with the last one.
std::vector<Row> command_block() {
  using C = CommandRegisters&;
  using Value = std::uint32_t;
  return {
      holding(
          0, Type::I32, "argument", {1, "", -kMaxI32 - 1, kMaxI32}, "Argument of the command",
          [](S s, Index) { return static_cast<Value>(s.command.argument); },
          [](C c, Value value) { c.argument = static_cast<std::int32_t>(value); }),
      holding(
          2, Type::U16, "command", enumerated(command_codes()), listed(command_codes()),
          [](S s, Index) { return Value{s.command.command}; },
          [](C c, Value value) { c.command = static_cast<std::uint16_t>(value); }),
      holding(
          3, Type::U16, "command_sequence", {1, "", 0, kMaxU16},
          "Another value than acknowledged_sequence carries the command out, once",
          [](S s, Index) { return Value{s.command.sequence}; },
          [](C c, Value value) { c.sequence = static_cast<std::uint16_t>(value); }),
      holding(4, Type::U16, "acknowledged_sequence", {1, "", 0, kMaxU16},
              "command_sequence of the last command that was carried out",
              [](S s, Index) { return Value{s.command.acknowledged}; }),
      holding(5, Type::U16, "command_result", enumerated(command_result_codes()),
              "Result of that command: " + listed(command_result_codes()),
              [](S s, Index) { return static_cast<Value>(s.command.result); }),
      holding(6, Type::U16, "last_command", enumerated(command_codes()),
              "Code of that command; 0: none yet",
              [](S s, Index) { return Value{s.command.last_command}; }),
      reserved(Table::Holding, 7, 16),
  };
}

/// The same value for PLCs that can read only coils and holding registers.
Row mirrored(Row row) {
  row.table = row.table == Table::Discrete ? Table::Coil : Table::Holding;
  row.address += kMirrorOffset;
  return row;
}

}  // namespace

std::vector<Row> register_rows() {
  std::vector<Row> rows;
  for (auto* block : {discrete_block, system_block, signal_block, camera_block, view_block}) {
    for (Row& row : block()) {
      rows.push_back(mirrored(row));
      rows.push_back(std::move(row));
    }
  }
  std::ranges::move(command_block(), std::back_inserter(rows));
  std::ranges::sort(rows, {}, [](const Row& row) { return std::pair(row.table, row.address); });
  return rows;
}

}  // namespace orbwatch::app::modbus
