// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/simulated_controller.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "app/simulation/scene/process.h"

namespace orbwatch::app::simulation {
namespace {

constexpr double kProgram = 1001;
constexpr double kTracks = 8;        // per lap
constexpr double kPowerPerArea = 6;  // W/mm^2 of the molten area, as in cladding
constexpr double kPowderFlow = 12;   // g/min

}  // namespace

MachineState state_at(const MachineSettings& settings, double seconds) {
  const MeltPool pool = process_at(settings, seconds).pool;
  const PoolSettings& path = settings.pool;
  const double laps = seconds / path.lap_time;
  const double lap = std::floor(laps);
  MachineState state;
  state.part = *PartName::make("ring " + std::to_string(settings.seed));
  MachineValues& v = state.values;
  v.program = kProgram;
  v.layer = lap + 1;
  v.track = std::floor(kTracks * (laps - lap)) + 1;
  v.x = pool.centre.x;
  v.y = pool.centre.y;
  v.z = pool.centre.z;
  v.a = v.b = v.c = 0;
  v.feed = 60 * 2 * std::numbers::pi * path.path_radius / path.lap_time;
  v.laser_power = kPowerPerArea * std::numbers::pi * pool.radius * pool.radius;
  v.powder_flow = kPowderFlow;
  v.laser_on = v.program_running = 1;
  return state;
}

SimulatedController::SimulatedController(std::shared_ptr<const Machine> machine,
                                         MachineStateHandler handler)
    : machine_(std::move(machine)), handler_(std::move(handler)) {}

void SimulatedController::start() {
  thread_.start("controller", [this] {
    std::uint32_t sequence = 0;
    for (hal::TimePoint due = hal::Clock::now(); thread_.wait_until(due); due += kPeriod) {
      MachineState state = state_at(machine_->settings(), machine_->process_time(due));
      state.sequence = ++sequence;
      state.clock = std::chrono::duration<double>(due.time_since_epoch()).count();
      // The simulation sends only what check() accepts; its test shows that.
      static_cast<void>(handler_(state));
    }
  });
}

}  // namespace orbwatch::app::simulation
