// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "app/machine/controller_clock.h"
#include "app/machine/machine_settings.h"
#include "app/machine/state_track.h"
#include "app/machine/trigger_agreement.h"
#include "app/model/machine/machine_state.h"
#include "app/model/machine/machine_status.h"
#include "hal/thread/priority_mutex.h"
#include "proc/optics/vec.h"

namespace orbwatch::app::machine {

/// States of the machine, associated with exposures by time. A state's moment is its arrival less
/// the configured delay, or what the controller's clock says, see ControllerClock; of states with
/// one clock the first is kept. Thread rule: take() on any thread, the rest on the pipeline's;
/// nobody waits for longer than a copy.
class MachineFollower {
 public:
  explicit MachineFollower(const MachineSettings& settings);

  /// The way for the interfaces.
  MachinePath path();

  /// Takes a state that arrived at `arrival`; one with the sequence of the state before is ignored.
  /// Error: check()'s; it is logged, at most once a second. A clock that stands is logged, at most
  /// once an hour.
  Result<> take(const MachineState& state, hal::TimePoint arrival);

  /// @name The machine in the machine frame of the rig; valid until the next call of either. A
  /// beginning or ending fault is logged.
  /// @{

  /// At the exposure of a frame set. `trigger`: number of the edge that began it, to be compared
  /// with the controller's count.
  const MachineStatus& follow(hal::TimePoint moment, std::optional<std::uint64_t> trigger);
  /// Between frame sets: as at the last exposure, but nothing once the machine is silent at `now`.
  /// A fault ends when states arrive again, not only at the next exposure, for which a PLC may wait
  /// with its trigger; the values are not known until then.
  const MachineStatus& keep(hal::TimePoint now);
  /// @}

 private:
  TimedState in_machine_frame(const MachineState& state) const;
  void refuse(const Error& error, hal::TimePoint now);
  /// Dates and keeps a state; mutex_ is held.
  void add(const MachineState& state, TimedState placed, hal::TimePoint arrival);
  void say_clock(hal::TimePoint now);
  /// Begins or ends a fault at `now`; mutex_ is held.
  void update_fault(hal::TimePoint now);
  void say_quality(MachineQuality before) const;

  const MachineSettings settings_;
  const optics::Mat3 rotation_;  ///< from the controller's frame to the machine frame
  hal::PriorityMutex mutex_;     ///< guards the members up to status_
  ControllerClock clock_;
  StateTrack track_;
  std::optional<std::uint32_t> sequence_;
  std::uint64_t states_ = 0;
  std::uint64_t refused_ = 0;
  hal::TimePoint next_log_{};        ///< of a refusal
  hal::TimePoint next_clock_log_{};  ///< of a clock that stands

  MachineStatus status_;  ///< the pipeline's, like the rest
  TriggerAgreement triggers_;
};

}  // namespace orbwatch::app::machine
