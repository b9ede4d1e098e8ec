// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/machine.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace orbwatch::app::simulation {
namespace {

TEST(Machine, TakesItsDefaults) { EXPECT_TRUE(Machine::make({}, hal::Clock::now())); }

TEST(Machine, CountsProcessTimeFromItsEpoch) {
  const hal::TimePoint epoch = hal::Clock::now();
  const auto machine = *Machine::make({}, epoch);
  EXPECT_EQ(machine->process_time(epoch), 0);
  EXPECT_DOUBLE_EQ(machine->process_time(epoch + std::chrono::milliseconds(1500)), 1.5);
  EXPECT_DOUBLE_EQ(machine->process_time(epoch - std::chrono::milliseconds(250)), -0.25);
}

struct Refusal {
  const char* word;  // required in the message
  std::function<void(MachineSettings&)> spoil;
};

TEST(Machine, RefusesWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Refusal> refusals{
      {"enclosure", [](MachineSettings& s) { s.enclosure.lo.x = 700; }},
      {"table", [](MachineSettings& s) { s.table.hi.z = 900; }},
      {"table", [](MachineSettings& s) { s.table.hi.z = s.table.lo.z; }},
      {"workpiece", [](MachineSettings& s) { s.workpiece.lo.x = -700; }},
      {"ball", [](MachineSettings& s) { s.ball.centre.x = 580; }},
      {"ball", [](MachineSettings& s) { s.ball.radius = 0; }},
      {"ball", [&](MachineSettings& s) { s.ball.radius = nan; }},
      {"ball", [](MachineSettings& s) { s.ball.centre.z = 180; }},
      {"path", [](MachineSettings& s) { s.pool.path_radius = 90; }},
      {"lap time", [](MachineSettings& s) { s.pool.lap_time = 0; }},
      {"radius", [](MachineSettings& s) { s.pool.radius = -1; }},
      {"swing", [](MachineSettings& s) { s.pool.radius_swing = 1; }},
      {"melting point", [](MachineSettings& s) { s.pool.peak = 1400; }},
      {"melting point", [](MachineSettings& s) { s.workpiece_temperature = 1500; }},
      {"ranges",
       [](MachineSettings& s) {
         s.sparks.speed = {2, 1};
       }},
      {"rate", [](MachineSettings& s) { s.sparks.rate = 1000; }},
      {"rate", [&](MachineSettings& s) { s.sparks.rate = nan; }},
      {"nozzle", [](MachineSettings& s) { s.nozzle.tip_radius = 30; }},
      {"ceiling", [](MachineSettings& s) { s.nozzle.standoff = 600; }},
      {"clear of the ball", [](MachineSettings& s) { s.nozzle.column_radius = 200; }},
  };
  for (const Refusal& refusal : refusals) {
    MachineSettings settings;
    refusal.spoil(settings);
    const auto machine = Machine::make(settings, {});
    ASSERT_FALSE(machine) << refusal.word;
    EXPECT_NE(machine.error().message.find(refusal.word), std::string::npos)
        << machine.error().message;
  }
}

}  // namespace
}  // namespace orbwatch::app::simulation
