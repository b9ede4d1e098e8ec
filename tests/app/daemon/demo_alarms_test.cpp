// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "app/daemon/site/site_plan.h"
#include "app/simulation/scene/process.h"
#include "proc/signals/alarm.h"
#include "tests/app/daemon/demo_site.h"
#include "tests/app/daemon/measured_machine.h"

/// Alarms of the shipped demo over the machine's simulated process.
namespace orbwatch::app::daemon {
namespace {

using std::chrono::nanoseconds;

/// The demo's pool, measured as its recipe says, without the thread and the clock of a daemon.
class DemoPool {
 public:
  DemoPool()
      : site_(demo()),
        plan_(SitePlan::make(site_, expected_formats(site_)).value()),
        measured_({}, thermal_camera(), plan_.recipes.front().views.front().projection.spec(),
                  plan_.recipes.front().regions.front().settings) {}

  double frame_rate() const { return camera().stream.frame_rate; }
  const std::vector<signals::AlarmLimits>& alarms() const { return plan_.recipes.front().alarms; }
  signals::Signals measure(double seconds) { return measured_.measure(seconds); }

 private:
  const files::CameraSettings& camera() const { return site_.site.cameras[kThermalCamera]; }
  simulation::Pinhole thermal_camera() const {
    const auto& simulated = std::get<simulation::SimulatedCameraSettings>(camera().back_end);
    return simulation::look_at(simulated.position, simulation::MachineSettings{}.ball.centre,
                               simulated.horizontal_fov, camera().stream.width,
                               camera().stream.height);
  }

  files::Resolved site_;
  SitePlan plan_;
  MeasuredMachine measured_;
};

/// Alarms that come every few seconds teach users to ignore them.
TEST(DemoAlarms, AreRaisedAboutOnceAMinuteWhileThePoolIsHot) {
  constexpr double kSeconds = 154;  // two beats of the periods of size and heat, 7 s and 11 s
  const simulation::MachineSettings machine;
  DemoPool pool;
  std::vector<signals::AlarmMemory> memories(pool.alarms().size());
  std::vector<double> raised;  // s
  for (double seconds = 0; seconds < kSeconds; seconds += 1 / pool.frame_rate()) {
    const signals::Signals signals = pool.measure(seconds);
    for (std::size_t i = 0; i < memories.size(); ++i) {
      const signals::AlarmLimits& limits = pool.alarms()[i];
      ASSERT_EQ(limits.region, 0U) << "another region than the pool";
      const double value = signals.*signals::kSignals[limits.signal].member;
      const nanoseconds now(static_cast<std::int64_t>(1e9 * seconds));
      const signals::AlarmMemory next = step(limits, memories[i], {now, value});
      if (is_raised(memories[i].alarm, next.alarm)) {
        raised.push_back(seconds);
        EXPECT_GT(process_at(machine, seconds).pool.peak, machine.pool.peak)
            << signals::kSignals[limits.signal].name << " after " << seconds << " s";
      }
      memories[i] = next;
    }
  }
  ASSERT_FALSE(raised.empty());
  EXPECT_LT(raised.front(), 60) << "a new user sees one";
  EXPECT_LE(raised.size(), 5U) << testing::PrintToString(raised);
}

}  // namespace
}  // namespace orbwatch::app::daemon
