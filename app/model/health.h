#pragma once

#include <array>
#include <string_view>

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
  X(disk_free, "MiB", 1, 0, 2e9, "Free for orbwatch on the disk that it records to")              \
  X(disk_free_share, "%", 0.1, 0, 100, "The same, of the file system's size")                     \
  X(clock_synchronised, "", 1, 0, 1, "1: the system's clock follows a time server")               \
  X(clock_estimated_error, "ms", 0.001, 0, 1e6, "Error of the system's clock as its server says") \
  X(clock_maximum_error, "ms", 0.001, 0, 1e6, "Bound of that error; grows until the next answer") \
  X(resident_memory, "MiB", 0.1, 0, 1e8, "Memory that orbwatch itself holds")                     \
  X(open_descriptors, "", 1, 0, 1e9, "Files, devices and connections that orbwatch has open")

/// Health of the appliance; signals::kNotValid where this board cannot measure a figure.
struct Health {
#define ORBWATCH_MEMBER(name, unit, scale, minimum, maximum, description) \
  double name = signals::kNotValid;
  ORBWATCH_HEALTH(ORBWATCH_MEMBER)
#undef ORBWATCH_MEMBER
};

/// The facts about one figure, for translators and manuals.
struct HealthInfo {
  std::string_view name;
  std::string_view unit;
  double scale;
  double minimum;
  double maximum;
  std::string_view description;
  double Health::*member;
};

inline constexpr std::array kHealthFigures{
#define ORBWATCH_INFO(name, unit, scale, minimum, maximum, description) \
  HealthInfo{#name, unit, scale, minimum, maximum, description, &Health::name},
    ORBWATCH_HEALTH(ORBWATCH_INFO)
#undef ORBWATCH_INFO
};

}  // namespace orbwatch::app
