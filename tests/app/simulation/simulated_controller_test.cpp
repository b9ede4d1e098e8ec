// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/simulated_controller.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <vector>

#include "app/simulation/scene/process.h"

namespace orbwatch::app::simulation {
namespace {

TEST(SimulatedController, ItsStateIsThatOfTheProcess) {
  const MachineSettings settings;
  for (double t = 0; t < 100; t += 0.37) {
    const MachineState state = state_at(settings, t);
    const MeltPool pool = process_at(settings, t).pool;
    EXPECT_EQ(state.values.x, pool.centre.x);
    EXPECT_EQ(state.values.y, pool.centre.y);
    EXPECT_EQ(state.values.z, pool.centre.z);
    const auto checked = check(state);
    EXPECT_TRUE(checked) << checked.error().message;
  }
  EXPECT_EQ(state_at(settings, settings.pool.lap_time - 0.01).values.layer, 1);
  EXPECT_EQ(state_at(settings, settings.pool.lap_time + 0.01).values.layer, 2);
}

TEST(SimulatedController, SendsNumberedStates) {
  const hal::TimePoint epoch = hal::Clock::now();
  const auto machine = Machine::make({}, epoch).value();
  std::mutex mutex;
  std::condition_variable arrived;
  std::vector<MachineState> states;
  SimulatedController controller(machine, [&](const MachineState& state) -> Result<> {
    const std::lock_guard lock(mutex);
    states.push_back(state);
    arrived.notify_one();
    return {};
  });
  controller.start();
  {
    std::unique_lock lock(mutex);
    ASSERT_TRUE(arrived.wait_for(lock, std::chrono::minutes(1), [&] { return states.size() > 4; }));
  }
  controller.stop();
  for (std::size_t n = 0; n < states.size(); ++n) {
    EXPECT_EQ(states[n].sequence, n + 1);
    const hal::TimePoint moment(std::chrono::duration_cast<hal::Clock::duration>(
        std::chrono::duration<double>(states[n].clock)));
    const MachineState truth = state_at(machine->settings(), machine->process_time(moment));
    EXPECT_NEAR(states[n].values.x, truth.values.x, 0.01);
  }
}

}  // namespace
}  // namespace orbwatch::app::simulation
