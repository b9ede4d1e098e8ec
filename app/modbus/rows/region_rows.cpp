#include <algorithm>

#include "app/modbus/alarm_summary.h"
#include "app/modbus/codes.h"
#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {
namespace {

constexpr int kSignalCount = signals::kSignals.size();
constexpr int kValidWords = 4;

static_assert(kSignalCount <= 16 * kValidWords);
static_assert(kRegionSignals + 2 * kSignalCount <= kMaxReadRegisters,
              "one request reads a region with its identity");
static_assert(kLiveBlock + int{signals::kMaxRegions} * kRegionStride <= kResultBlock);
static_assert(kResultBlock + int{signals::kMaxRegions} * kRegionStride <= kMirrorOffset);
static_assert(std::ranges::all_of(signals::kSignals, fits<signals::SignalInfo>));

/// Bits of the signals from `first` on that have a value.
std::uint16_t valid_word(const signals::Signals& signals, std::size_t first) {
  std::uint16_t word = 0;
  for (std::size_t i = 0; i < 16 && first + i < kSignalCount; ++i) {
    const auto& info = signals::kSignals[first + i];
    const bool valid = scaled(signals.*info.member, quantity_of(info)) != kNotValidCode;
    word = static_cast<std::uint16_t>(word | (valid ? 1U : 0U) << i);
  }
  return word;
}

/// By which a PLC knows what it has read. It begins a structure whose 32-bit members stand at even
/// places.
void append_header(Block<Moment>& block, std::size_t region) {
  using M = const Moment&;
  block
      .u32("result", kCounter, "Number of the result; live, of the newest one; 0: none",
           [](M m) { return m.status.result; })
      .u32("frame_set", kCounter, "Number of the frame set that was measured",
           [](M m) { return m.status.frame_set; })
      .u32("utc_seconds", {1, "s", 0, kMaxU32},
           "UTC of its exposure start, seconds since 1970; 0: none yet",
           [](M m) { return m.utc.count() / 1000000; })
      .u32("utc_microseconds", {1, "us", 0, 999999}, "Microseconds within that second",
           [](M m) { return m.utc.count() % 1000000; })
      .u32("trigger", kCounter, "Number of the trigger that began it; 0: none did",
           [](M m) { return m.status.trigger; })
      .u32("configuration_checksum", kCounter, "CRC-32 of all files of the configuration then",
           [](M m) { return m.status.configuration_checksum; })
      .u16("recipe", kWord, "Number of the recipe that it was measured with",
           [](M m) { return m.status.recipe; })
      .u16("quality", range_of(quality_codes()), listed(quality_codes()),
           [region](M m) { return m.status.regions[region].quality; })
      .u16("process_active", {1, "", 0, 1}, "1: the process ran",
           [](M m) { return m.status.process_active; })
      .u16("alarm_severity", range_of(severity_codes()),
           "The worst alarm of this region that stood: " + listed(severity_codes()),
           [region](M m) { return worst_severity(m.status, region); });
  for (std::size_t i = 0; i < kValidWords; ++i) {
    const std::string first = std::to_string(16 * i);
    block.u16("valid_" + first, kWord, "Bit n: signal " + first + " + n has a value",
              [region, i](M m) { return valid_word(m.status.regions[region].signals, 16 * i); });
  }
}

/// One structure for what is measured now and for results.
std::vector<Row> rows_of_region(int base, const std::string& prefix, std::size_t region,
                                const Block<Moment>::Find& moment) {
  Block<Moment> block(Table::Input, base, prefix, moment);
  append_header(block, region);
  block.reserved_to(base + kRegionSignals);
  for (const signals::SignalInfo& signal : signals::kSignals) {
    block.i32(std::string(signal.name), quantity_of(signal), std::string(signal.description),
              [region, member = signal.member](const Moment& moment_then) {
                return moment_then.status.regions[region].signals.*member;
              });
  }
  return block.reserved_to(base + kRegionStride).rows();
}

}  // namespace

std::vector<Row> region_rows() {
  std::vector<Row> rows = joined(signals::kMaxRegions, [](std::size_t region) {
    return rows_of_region(kLiveBlock + static_cast<int>(region) * kRegionStride,
                          "region_" + std::to_string(region) + "_", region,
                          [](const Snapshot& s) -> const Moment& { return s.live; });
  });
  std::ranges::move(
      joined(signals::kMaxRegions,
             [](std::size_t region) {
               return rows_of_region(
                   kResultBlock + static_cast<int>(region) * kRegionStride,
                   "result_" + std::to_string(region) + "_", region,
                   [](const Snapshot& s) -> const Moment& { return s.results.oldest; });
             }),
      std::back_inserter(rows));
  return rows;
}

}  // namespace orbwatch::app::modbus
