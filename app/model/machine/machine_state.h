// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "app/model/machine/machine_values.h"
#include "app/model/machine/part_name.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// One state of the machine as its controller sends it.
struct MachineState {
  /// Number of the state: one that equals that of the state before is ignored. Nullopt: none is.
  std::optional<std::uint32_t> sequence;
  /// The controller's clock at the moment of the state, s since any moment; NaN: it sends none.
  double clock = signals::kNotValid;
  PartName part{};
  MachineValues values{};  ///< x, y, z in the controller's frame
};

/// Bound of a controller's clock, s: beyond it a double does not resolve 1 us.
inline constexpr double kMostClock = 4294967296;

/// Checks each value: not known, or in its range, and a whole number if it is a number without
/// unit. Error: "layer is 2.5; it must be a whole number, 0 to 2147483647". Reentrant.
Result<> check(const MachineState& state);

/// Interfaces by which states arrive; one is chosen.
enum class MachineSource : std::uint8_t { None, Modbus, Dds, Http, Simulation, Recording };

/// The name in the site file.
constexpr std::string_view name_of(MachineSource source) {
  switch (source) {
    case MachineSource::None:
      return "none";
    case MachineSource::Modbus:
      return "modbus";
    case MachineSource::Dds:
      return "dds";
    case MachineSource::Http:
      return "http";
    case MachineSource::Simulation:
      return "simulation";
    case MachineSource::Recording:
      return "recording";
  }
  return {};
}

/// Takes a state on its arrival. Error: check()'s. Thread-safe, does not wait.
using MachineStateHandler = std::function<Result<>(const MachineState&)>;

/// The way of states from an interface to what follows them.
struct MachinePath {
  MachineSource source = MachineSource::None;  ///< other interfaces refuse states
  MachineStateHandler handler;
  /// Counts and logs a message that is not a state, like a state that the handler refuses.
  /// Thread-safe, does not wait. Null: not counted.
  std::function<void(const Error&)> refused{};

  /// Hands over what an interface received. Error: the message's, or the handler's.
  Result<> take(const Result<MachineState>& state) const {
    if (state) return handler(*state);
    if (refused) refused(state.error());
    return tl::unexpected(state.error());
  }
};

/// Refusal of an interface that is not the source. Reentrant.
inline Error wrong_source(const MachinePath& path, MachineSource used) {
  return Error{"machine states are taken from source " + std::string(name_of(path.source)) +
               "; set source = \"" + std::string(name_of(used)) + "\" under [machine]"};
}

}  // namespace orbwatch::app
