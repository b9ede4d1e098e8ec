// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "app/model/machine/machine_state.h"
#include "app/simulation/machine.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::simulation {

/// State of the machine `seconds` after its epoch, in the machine frame: the tool is at the centre
/// of the pool, each lap is a layer of eight tracks. Settings are a Machine's. Reentrant.
MachineState state_at(const MachineSettings& settings, double seconds);

/// Controller of a simulated machine: sends its state 50 times a second, without a delay. Thread
/// rule: one owner.
class SimulatedController {
 public:
  static constexpr std::chrono::milliseconds kPeriod{20};

  /// `handler` is called on a thread of this. `machine` must not be null.
  SimulatedController(std::shared_ptr<const Machine> machine, MachineStateHandler handler);
  ~SimulatedController() { stop(); }

  void start();
  void stop() { thread_.stop(); }

 private:
  const std::shared_ptr<const Machine> machine_;
  const MachineStateHandler handler_;
  hal::Thread thread_;
};

}  // namespace orbwatch::app::simulation
