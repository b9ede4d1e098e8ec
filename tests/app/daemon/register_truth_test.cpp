// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/ports/modbus/modbus_sink.h"
#include "app/simulation/scene/process.h"
#include "proc/optics/vec.h"
#include "tests/app/daemon/measured_machine.h"
#include "tests/support/registers.h"

/// Compares registers read by a PLC with the simulated machine.
namespace orbwatch::app::daemon {
namespace {

using optics::Vec3;
using simulation::MachineSettings;

/// One machine, one region, and the server that reports it.
class RegisterTruth : public testing::Test {
 protected:
  void SetUp() override {
    settings_.sparks.rate = 0;
    settings_.nozzle.standoff = 70;  // hides no part of the pool
    ModbusSettings modbus;
    modbus.address = "127.0.0.1";
    modbus.port = 0;
    modbus.status_timeout = std::chrono::hours(1);
    sink_.emplace(modbus, [](const Command&) { return CommandResult::Done; });
    ASSERT_TRUE(sink_->start());
  }

  /// Measures `frames` frames, the last one at `seconds`, and passes the status to the server.
  void measure(double seconds, int frames = 1) {
    signals::RegionSettings region;
    region.hot_spot_threshold = counts(settings_.pool.melting_point);
    region.spatter_threshold = counts(700);
    region.radiometry.kelvin_per_count = kKelvinPerCount;
    MeasuredMachine machine(
        settings_, simulation::look_at({49.4, 395.4, 500.6}, settings_.ball.centre, 17, 1280, 1024),
        {optics::ViewKind::Perspective, {-115, -35, 0}, 120, {}, 1200, 900}, region);
    Status status;
    status.state = SystemState::Running;
    status.frame_set = ++frame_set_;
    status.stamp = hal::Clock::now();
    status.region_count = 1;
    for (int n = frames - 1; n >= 0; --n) {
      status.regions[0] = {Quality::Apparent, machine.measure(seconds - n / 30.0)};
    }
    sink_->accept(status);
    pool_ = simulation::process_at(settings_, seconds).pool;
  }

  double read(const std::string& signal, double scale) const {
    return scale *
           static_cast<double>(tests::read_register(sink_->port(), "region_0_hot_spot_" + signal));
  }

  void expect_truth() const {
    const double area = std::numbers::pi * pool_.radius * pool_.radius;
    EXPECT_NEAR(read("area", 0.01), area, 0.03 * area);
    EXPECT_NEAR(read("width", 0.001), 2 * pool_.radius, 0.04 * pool_.radius);
    EXPECT_NEAR(read("x", 0.01), pool_.centre.x, 1);
    EXPECT_NEAR(read("y", 0.01), pool_.centre.y, 1);
    EXPECT_NEAR(read("z", 0.01), pool_.centre.z, 0.1);
    const Vec3 d = optics::normalized(pool_.centre - settings_.ball.centre);
    EXPECT_NEAR(read("yaw", 0.01), optics::degrees(std::atan2(d.x, d.y)), 0.3);
    EXPECT_NEAR(read("pitch", 0.01), optics::degrees(std::asin(d.z)), 0.3);
    EXPECT_NEAR(read("peak_temperature", 0.1), pool_.peak, 0.01 * 65535 * kKelvinPerCount);
  }

  MachineSettings settings_;
  std::optional<ModbusSink> sink_;
  simulation::MeltPool pool_;
  std::uint64_t frame_set_ = 0;
};

TEST_F(RegisterTruth, PoolRegistersFollowItsSizePlaceAndHeat) {
  for (const double radius : {10.0, 14.0}) {
    for (const double peak : {1750.0, 2100.0}) {
      for (const double seconds : {0.0, 3.0, 6.0}) {
        SCOPED_TRACE(std::to_string(radius) + " mm, " + std::to_string(peak) + " degC, " +
                     std::to_string(seconds) + " s");
        settings_.pool.radius = radius;
        settings_.pool.peak = peak;
        measure(seconds);
        expect_truth();
      }
    }
  }
}

TEST_F(RegisterTruth, SpatterRateFollowsTheSparks) {
  for (const double rate : {0.0, 30.0, 90.0}) {
    settings_.sparks.rate = rate;
    measure(20, 45);
    const double told =
        0.1 * static_cast<double>(tests::read_register(sink_->port(), "region_0_spatter_rate"));
    EXPECT_NEAR(told, rate, 3 * std::sqrt(rate) + 0.15 * rate) << "the sparks come at random";
  }
}

}  // namespace
}  // namespace orbwatch::app::daemon
