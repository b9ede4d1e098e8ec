// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/model/command/command.h"
#include "app/model/status/field.h"

/// Numbers of a machine's state, each declared once; the part has a name.
namespace orbwatch::app {

/// Derivation of a value at an exposure from the states around it.
enum class Between : std::uint8_t {
  Held,          ///< that of the state before
  Interpolated,  ///< on the line between both
  Turned,        ///< likewise, on the shorter way round: deg, modulo 360
};

inline constexpr Quantity kMachineNumber{"", 1, 0, 2147483647};
inline constexpr Quantity kMachinePosition{"mm", 0.001, -kMaxCoordinate, kMaxCoordinate};
inline constexpr Quantity kMachineAngle{"deg", 0.001, -36000, 36000};
inline constexpr Quantity kMachineFeed{"mm/min", 0.1, 0, 1e6};
inline constexpr Quantity kMachinePower{"W", 0.1, 0, 1e6};
inline constexpr Quantity kMachineFlow{"g/min", 0.001, 0, 100000};

/// X(name, between, quantity, title, description): the lines of the values. Places and units go to
/// PLC and controller: append, never move or remove. In a sent state x, y, z are in the
/// controller's frame, in a status in the machine frame of the rig.
#define ORBWATCH_MACHINE_VALUES(X)                                                          \
  X(program, Held, kMachineNumber, "Program", "Number of the program")                      \
  X(layer, Held, kMachineNumber, "Layer", "Number of the layer")                            \
  X(track, Held, kMachineNumber, "Track", "Number of the track in the layer")               \
  X(x, Interpolated, kMachinePosition, "Tool X", "Position of the tool, x")                 \
  X(y, Interpolated, kMachinePosition, "Tool Y", "Position of the tool, y")                 \
  X(z, Interpolated, kMachinePosition, "Tool Z", "Position of the tool, z")                 \
  X(a, Turned, kMachineAngle, "Axis A", "Rotary axis A")                                    \
  X(b, Turned, kMachineAngle, "Axis B", "Rotary axis B")                                    \
  X(c, Turned, kMachineAngle, "Axis C", "Rotary axis C")                                    \
  X(feed, Held, kMachineFeed, "Feed", "Commanded feed")                                     \
  X(laser_power, Held, kMachinePower, "Laser power", "Laser power")                         \
  X(powder_flow, Held, kMachineFlow, "Powder flow", "Powder flow")                          \
  X(laser_on, Held, kFlag, "Laser on", "1: the laser is on")                                \
  X(program_running, Held, kFlag, "Program running", "1: the program runs")                 \
  X(trigger_count, Held, kMachineNumber, "Triggers sent",                                   \
    "Camera triggers that the controller has sent; a step against the counted edges is an " \
    "association that is off by a frame")

/// The values; signals::kNotValid: not known.
struct MachineValues {
#define ORBWATCH_MEMBER(name, ...) double name = signals::kNotValid;
  ORBWATCH_MACHINE_VALUES(ORBWATCH_MEMBER)
#undef ORBWATCH_MEMBER
};

/// One value's facts. `get` is its member.
struct MachineValue : Field<double MachineValues::*> {
  Between between = Between::Held;
};

inline constexpr std::array kMachineValues{
#define ORBWATCH_VALUE(name, between, quantity, title, description)                   \
  MachineValue{make_field(#name, quantity, description, &MachineValues::name, title), \
               Between::between},
    ORBWATCH_MACHINE_VALUES(ORBWATCH_VALUE)
#undef ORBWATCH_VALUE
};

}  // namespace orbwatch::app
