// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "app/model/status/field.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {

/// X(name, unit, scale, minimum, maximum, description): the lines of the appliance's health
/// figures. A reading outside of minimum to maximum, in the unit, is discarded. Append, never move
/// or remove.
#define ORBWATCH_HEALTH(X)                                                                        \
  X(board_temperature, "degC", 0.1, -100, 200, "Hottest thermal zone of the board")               \
  X(throttling, "", 1, 0, 255,                                                                    \
    "Bits: 0 under-voltage, 1 capped, 2 throttled, 3 hot; 4 to 7 the same since power-on")        \
  X(processor_load, "%", 0.1, 0, 100, "Share of all processors' time since the last sample")      \
  X(processor_frequency, "MHz", 1, 0, 100000, "Present clock of the fastest processor")           \
  X(memory_available, "MiB", 1, 0, 1e9, "Memory that programs can get without swapping")          \
  X(disk_free, "MiB", 1, 0, 2e9, "Space available to orbwatch on the disk that it records to")    \
  X(disk_free_share, "%", 0.1, 0, 100, "Free share of the file system that it records to")        \
  X(clock_synchronised, "", 1, 0, 1, "1: the system's clock follows a time server")               \
  X(clock_estimated_error, "ms", 0.001, 0, 1e6,                                                   \
    "Estimated error of the system's clock, reported by its time service")                        \
  X(clock_maximum_error, "ms", 0.001, 0, 1e6, "Bound of that error; grows until the next answer") \
  X(resident_memory, "MiB", 0.1, 0, 1e8, "Resident memory of orbwatch itself")                    \
  X(open_descriptors, "", 1, 0, 1e9, "Files, devices and connections that orbwatch has open")     \
  X(commands_recorded, "", 1, 0, 1,                                                               \
    "1: each command is recorded on the disk first, so that no restart repeats it")               \
  X(disk_written_per_day, "MiB", 1, 0, 1e9,                                                       \
    "Written per day to the whole disk that it records to, by all programs, since power-on")

/// Causes of throttling, the low bits of Health::throttling. The bits are those of the Raspberry
/// Pi's firmware (vcgencmd get_throttled). The PLC reads the numbers: append, never renumber.
enum class Throttling : std::uint8_t {
  UnderVoltage = 1,
  FrequencyCapped = 2,
  Throttled = 4,
  SoftTemperatureLimit = 8,
};

/// Shifted up by so many places, a bit states that the cause occurred since power-on, as far as the
/// board or this program detected it.
inline constexpr int kSincePowerOn = 4;

/// Health of the appliance; signals::kNotValid where this board cannot measure a figure.
struct Health {
#define ORBWATCH_MEMBER(name, unit, scale, minimum, maximum, description) \
  double name = signals::kNotValid;
  ORBWATCH_HEALTH(ORBWATCH_MEMBER)
#undef ORBWATCH_MEMBER
};

/// The figures' descriptions, for interfaces and manuals.
inline constexpr std::array kHealthFigures{
#define ORBWATCH_FIGURE(name, unit, scale, minimum, maximum, description) \
  make_field(#name, {unit, scale, minimum, maximum}, description, &Health::name),
    ORBWATCH_HEALTH(ORBWATCH_FIGURE)
#undef ORBWATCH_FIGURE
};
using HealthField = decltype(kHealthFigures)::value_type;

}  // namespace orbwatch::app
