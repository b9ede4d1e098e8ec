// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>

#include "app/model/machine/machine_state.h"
#include "proc/optics/vec.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::machine {

/// The [machine] part of the site file.
struct MachineSettings {
  MachineSource source = MachineSource::None;
  std::chrono::milliseconds delay{0};      ///< from a state's moment to its arrival
  std::chrono::milliseconds timeout{500};  ///< without a state, after which nothing is known
  optics::Vec3 origin{};                   ///< of the controller's frame, machine frame, mm
  std::array<double, 3> rotation{};        ///< yaw, pitch, roll of its axes, deg
  optics::Vec3 tool_axis{0, 0, -1};        ///< at a = b = c = 0, controller's frame
};

inline constexpr std::array kMachineSources{Word{"none", MachineSource::None},
                                            Word{"modbus", MachineSource::Modbus},
                                            Word{"dds", MachineSource::Dds},
                                            Word{"http", MachineSource::Http},
                                            Word{"simulation", MachineSource::Simulation},
                                            Word{"recording", MachineSource::Recording}};

template <class Visitor>
void visit(Visitor& v, MachineSettings& machine) {
  v.optional("source", machine.source, kMachineSources,
             "Interface by which the controller sends its states: part, layer, tool position, "
             "laser; simulation: the simulated machine sends them; recording: those that were "
             "recorded with the frame sets that the cameras replay");
  v.optional("delay_ms", machine.delay, Milliseconds{Range::between(0, 1000)},
             "Age of a state on its arrival, ms: from the moment that it describes to the arrival "
             "of its message; with the controller's clock, of the fastest message");
  v.optional("timeout_ms", machine.timeout, Milliseconds{Range::between(10, 60000)},
             "Time without a state after which the values of the machine are not known, ms");
  v.optional("origin", machine.origin, kAnyNumber,
             "Origin of the controller's frame in the machine frame of the rig, mm");
  v.optional("rotation", machine.rotation, kAnyNumber,
             "Yaw, pitch and roll of the controller's axes in the machine frame, deg");
  v.optional("tool_axis", machine.tool_axis, kAnyNumber,
             "Direction of the tool in the controller's frame at a = b = c = 0; a, b and c turn it "
             "about x, then y, then z");
  v.require(optics::norm(machine.tool_axis) > 1e-9, "tool_axis",
            "is the zero vector, which has no direction; set for example [0, 0, -1]");
}

}  // namespace orbwatch::app::machine
