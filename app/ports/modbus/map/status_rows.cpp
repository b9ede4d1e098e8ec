#include <algorithm>
#include <iterator>

#include "app/model/condition.h"
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
static_assert(kCameras.has_room_for(kMaxCameras) && kViews.has_room_for(kMaxViews));

/// What combines several parts, or belongs to this interface alone.
std::vector<Row> summary_rows() {
  using I = const ProcessImage&;
  Block<ProcessImage> block(Table::Input, kSummary, "", whole_image);
  const auto word = [&block](std::string_view name, std::string_view description,
                             const std::vector<Bit>& bits) {
    block.row(Type::Udint, name, kDoubleWord, std::string(description),
              [&bits](I, I image) { return word_of(bits, image); });
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
           "Of the worst alarm that stands: " + listed_codes<Severity>(),
           [](I, I image) { return static_cast<int>(worst_severity(image.live.status)); });
  word("status_bits", "Bit n is discrete input n, bit 0 the lowest", status_bits());
  word("measurement_bits", "Bit n is discrete input 32 + n", measurement_bits());
  word("fault_bits", "What is wrong now: see the fault bits; 0: nothing", fault_bits());
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
  return std::move(block.rows());
}

/// The rows of a part that there is once.
template <class Part>
std::vector<Row> rows_of(Section section, const std::string& prefix,
                         typename Block<Part>::Find find) {
  return std::move(Block<Part>(Table::Input, section, prefix, std::move(find)).fields().rows());
}

std::vector<Row> rows_of_camera(std::size_t i) {
  Block<CameraStatus> block(
      Table::Input, kCameras.entry(i), "camera_" + std::to_string(i) + "_",
      [i](const ProcessImage& p) -> const CameraStatus& { return p.live.status.cameras[i]; });
  block.fields().absent("camera",
                        [i](const ProcessImage& p) { return i >= p.live.status.camera_count; });
  return std::move(block.rows());
}

std::vector<Row> rows_of_view(std::size_t i) {
  return rows_of<ViewStatus>(
      kViews.entry(i), "view_" + std::to_string(i) + "_",
      [i](const ProcessImage& p) -> const ViewStatus& { return p.live.status.views[i]; });
}

}  // namespace

std::vector<Row> status_rows() {
  using I = const ProcessImage&;
  std::vector<Row> rows;
  for (auto& block : {
           summary_rows(),
           rows_of<ResultQueueStatus>(
               kResultQueue, "result_", [](I p) -> auto& { return p.results; }),
           rows_of<SystemStatus>(
               kSystem, "system_", [](I p) -> auto& { return p.live.status; }),
           rows_of<Health>(
               kHealth, "health_", [](I p) -> auto& { return p.live.status.health; }),
           rows_of<PlcStatus>(
               kPlc, "plc_", [](I p) -> auto& { return p.plc; }),
           rows_of<ServerStatus>(
               kServer, "modbus_", [](I p) -> auto& { return p.server; }),
           joined(kMaxCameras, rows_of_camera),
           joined(kMaxViews, rows_of_view),
       }) {
    std::ranges::copy(block, std::back_inserter(rows));
  }
  return rows;
}

std::vector<Row> discrete_rows() {
  Block<ProcessImage> all(Table::Discrete, {kStatusBits.begin, kUnacknowledgedBits.end}, "",
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
  return std::move(all.rows());
}

}  // namespace orbwatch::app::modbus
