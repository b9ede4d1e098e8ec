// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Addresses of the blocks of the register map. Within a map version no block moves; each has
/// reserved places for fields appended to the model.
namespace orbwatch::app::modbus {

/// Grows with every change that an existing PLC program could notice. Rows appended in reserved
/// places do not count as a change.
inline constexpr int kMapVersion = 3;

/// Discrete input n is also coil n + 5000, and input register n holding register n + 5000: some
/// PLCs read only coils and holding registers.
inline constexpr int kMirrorOffset = 5000;

/// Maximum of registers per read request (V1.1b3, 6.3).
inline constexpr int kMaxReadRegisters = 125;

/// A block of one part: addresses [begin, end).
struct Section {
  int begin = 0;
  int end = 0;

  constexpr int size() const { return end - begin; }
};

/// A block of entries with the same structure.
struct Series {
  int begin = 0;
  int stride = 0;
  int end = 0;

  constexpr Section entry(std::size_t index) const {
    const int first = begin + static_cast<int>(index) * stride;
    return {first, first + stride};
  }
  constexpr bool has_room_for(std::size_t count) const { return entry(count).begin <= end; }
};

// Input registers. One request reads the first four, which a PLC needs in each scan.
inline constexpr Section kSummary{0, 20};
inline constexpr Section kResultQueue{20, 28};
inline constexpr Section kSystem{28, 80};
inline constexpr Section kHealth{80, 124};
inline constexpr Section kPlc{128, 144};
inline constexpr Section kServer{144, 200};
inline constexpr Series kStageParts{200, 16, 328};
inline constexpr Section kMachine{328, 408};
inline constexpr Section kResultMachine{408, 488};
inline constexpr Section kLaterParts{488, 600};
inline constexpr Series kCameras{600, 60, 1100};
inline constexpr Series kViews{1100, 24, 1500};
inline constexpr Section kAlarmSummary{1500, 1520};
inline constexpr Series kAlarms{1520, 16, 2600};
inline constexpr Series kRegions{2600, 128, 3700};
inline constexpr Series kResults{3700, 128, 5000};

/// Signals in the first block of a region, after its 16 registers of header and one valid bit per
/// signal.
inline constexpr int kRegionHeader = 16;
inline constexpr int kValidWords = 4;
inline constexpr std::size_t kFirstSignals = (kMaxReadRegisters - kRegionHeader - kValidWords) / 2;

// Blocks for signals beyond the first block of a region.
inline constexpr Series kMoreOfRegions{10000, 512, 15000};
inline constexpr Series kMoreOfResults{15000, 512, 20000};

// Discrete inputs.
inline constexpr Section kStatusBits{0, 32};
inline constexpr Section kMeasurementBits{32, 64};
inline constexpr Section kProcessInputBits{64, 96};
inline constexpr Section kLaterBits{96, 128};
inline constexpr Section kActiveBits{128, 192};
inline constexpr Section kUnacknowledgedBits{192, 256};

/// Holding registers that the PLC writes: commands and acknowledgements, and the machine's state.
inline constexpr Section kWritten{0, 100};
inline constexpr Section kMachineState{100, 200};
/// Least extent of a write to the machine's state, so that its values belong together; values
/// appended later may be left out.
inline constexpr Section kWholeMachineState{100, 152};

}  // namespace orbwatch::app::modbus
