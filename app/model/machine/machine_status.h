// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "app/model/machine/machine_values.h"
#include "app/model/machine/part_name.h"
#include "app/model/status/field.h"

namespace orbwatch::app {

/// Reliability of what the machine says, at an exposure. The numbers go to the PLC: append, never
/// renumber.
enum class MachineQuality : std::uint8_t {
  NotConfigured = 0,
  Good = 1,
  Predicted = 2,
  NoState = 3,
  Stale = 4,
};

/// The one place of the operator's text for each quality. Empty for a number that is none.
constexpr std::string_view operator_text(MachineQuality quality) {
  switch (quality) {
    case MachineQuality::NotConfigured:
      return "no machine states are configured";
    case MachineQuality::Good:
      return "good: between two states";
    case MachineQuality::Predicted:
      return "good: continued from the last two states";
    case MachineQuality::NoState:
      return "no state of the machine has arrived";
    case MachineQuality::Stale:
      return "stale: the machine's states stopped, its values are not known";
  }
  return {};
}

/// True: the machine's state is needed and not known.
constexpr bool is_fault(MachineQuality quality) {
  return quality == MachineQuality::NoState || quality == MachineQuality::Stale;
}

inline constexpr Quantity kToolVelocity{"mm/s", 0.01, -1e6, 1e6};
inline constexpr Quantity kDirection{"", 0.0001, -1, 1};

#define ORBWATCH_MACHINE_FIGURES(FIELD, AGE)                                                  \
  FIELD(MachineQuality, quality, kCode, "Reliability of the machine's state at the exposure") \
  AGE(state, "Time since the moment of the state before the exposure")

#define ORBWATCH_MACHINE_MOTION(FIELD)                                                             \
  FIELD(double, vx, kToolVelocity, "Velocity of the tool, x, from the states around the exposure") \
  FIELD(double, vy, kToolVelocity, "Velocity of the tool, y")                                      \
  FIELD(double, vz, kToolVelocity, "Velocity of the tool, z")                                      \
  FIELD(double, tool_x, kDirection, "Direction of the tool, x")                                    \
  FIELD(double, tool_y, kDirection, "Direction of the tool, y")                                    \
  FIELD(double, tool_z, kDirection, "Direction of the tool, z")                                    \
  FIELD(std::uint64_t, states, kCount, "States taken since start")                                 \
  FIELD(std::uint64_t, refused, kCount, "States refused: a value out of range, or not a number")   \
  FIELD(std::uint64_t, slips, kCount,                                                              \
        "Steps of the controller's trigger count against the edges of the trigger line: an "       \
        "association was off by a frame")

/// The machine at the exposure of the newest frame set, in the machine frame of the rig.
struct MachineStatus {
  ORBWATCH_MACHINE_FIGURES(ORBWATCH_FIELD_MEMBER, ORBWATCH_AGE_MEMBER)
  PartName part;
  MachineValues values;
  ORBWATCH_MACHINE_MOTION(ORBWATCH_FIELD_MEMBER)

  /// Sets part, values and motion to not known, for this reason; age and counts stay.
  void forget(MachineQuality reason) {
    quality = reason;
    part = {};
    values = {};
    vx = vy = vz = tool_x = tool_y = tool_z = signals::kNotValid;
  }
};

/// Reads one value of a status.
struct MachineValueOf {
  double MachineValues::*member;
  double operator()(const MachineStatus& machine) const { return machine.values.*member; }
};

template <class Visit>
constexpr void for_each_field(std::type_identity<MachineStatus>, Visit&& visit) {
  using Part = MachineStatus;
  ORBWATCH_MACHINE_FIGURES(ORBWATCH_VISIT_FIELD, ORBWATCH_VISIT_AGE)
  visit(make_field("part", kCode, "Name of the part", &MachineStatus::part, "Part"));
  for (const MachineValue& value : kMachineValues) {
    visit(make_field(value.name, value, value.description, MachineValueOf{value.get}, value.title));
  }
  ORBWATCH_MACHINE_MOTION(ORBWATCH_VISIT_FIELD)
}

}  // namespace orbwatch::app
