#include "app/modbus/register_values.h"

#include <gtest/gtest.h>

#include <limits>

namespace orbwatch::app::modbus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr signals::SignalInfo kAngle{"angle", "deg", 0.01, -180, 180, "", nullptr};

std::int32_t code(double value) { return static_cast<std::int32_t>(scaled(value, kAngle)); }

TEST(RegisterValues, SignalsAreRoundedAndSigned) {
  EXPECT_EQ(code(0), 0);
  EXPECT_EQ(code(12.344), 1234);
  EXPECT_EQ(code(12.346), 1235);
  EXPECT_EQ(code(-12.344), -1234);
  EXPECT_EQ(code(-12.346), -1235);
}

TEST(RegisterValues, SignalsStayInTheirRange) {
  EXPECT_EQ(code(180.0000001), 18000);
  EXPECT_EQ(code(1e300), 18000);
  EXPECT_EQ(code(-1e300), -18000);
}

TEST(RegisterValues, WhatIsNoNumberIsNotValid) {
  EXPECT_EQ(scaled(signals::kNotValid, kAngle), 0x80000000U);
  EXPECT_EQ(scaled(kInfinity, kAngle), 0x80000000U);
  EXPECT_EQ(scaled(-kInfinity, kAngle), 0x80000000U);
}

TEST(RegisterValues, NoValueInRangeReadsAsNotValid) {
  for (const auto& signal : signals::kSignals) {
    EXPECT_NE(scaled(signal.minimum, signal), 0x80000000U) << signal.name;
    EXPECT_NE(scaled(signal.maximum, signal), 0x80000000U) << signal.name;
  }
}

TEST(RegisterValues, FiguresSaturateInsteadOfWrapping) {
  EXPECT_EQ(saturated(29.974, 0.01), 2997U);
  EXPECT_EQ(saturated(655.35, 0.01), 65535U);
  EXPECT_EQ(saturated(655.36, 0.01), 65535U);
  EXPECT_EQ(saturated(kInfinity, 0.01), 65535U);
  EXPECT_EQ(saturated(-1, 0.01), 0U);
  EXPECT_EQ(saturated(signals::kNotValid, 0.01), 0U);
}

TEST(RegisterValues, AnAgeIsNeverNegative) {
  using std::chrono::milliseconds;
  EXPECT_EQ(age_code(milliseconds(-1)), 0U);
  EXPECT_EQ(age_code(milliseconds(123)), 123U);
  EXPECT_EQ(age_code(milliseconds(0x7fffffff)), 0x7fffffffU);
  EXPECT_EQ(age_code(milliseconds(0x80000000)), 0x7fffffffU);
  EXPECT_EQ(age_code(milliseconds::max()), 0x7fffffffU);
}

TEST(RegisterValues, CountersGoOnAtZero) {
  EXPECT_EQ(low_word(0xffffffffU), 0xffffffffU);
  EXPECT_EQ(low_word(0x100000000U), 0U);
}

TEST(RegisterValues, StatusBitsSayWhatTheStatusSays) {
  Snapshot snapshot;
  EXPECT_EQ(status_bits(snapshot), 0U);  // starting, no camera, no hot spot
  snapshot.status.state = SystemState::Running;
  EXPECT_EQ(status_bits(snapshot), 0b0001U);
  snapshot.status.state = SystemState::Degraded;
  EXPECT_EQ(status_bits(snapshot), 0b0010U);
  snapshot.status.state = SystemState::Fault;
  EXPECT_EQ(status_bits(snapshot), 0b0100U);
  snapshot.status.signals.hot_spot_area = 0;
  EXPECT_EQ(status_bits(snapshot), 0b0100U);
  snapshot.status.signals.hot_spot_area = 0.001;
  EXPECT_EQ(status_bits(snapshot), 0b1100U);
  snapshot.status.camera_count = 3;
  snapshot.status.cameras[1].fault = hal::Fault::Unplugged;
  EXPECT_EQ(status_bits(snapshot), 0b101'0000'1100U);
  snapshot.stale = true;  // nobody knows whether the cameras still deliver
  EXPECT_EQ(status_bits(snapshot), 0b000'0001'1100U);
}

}  // namespace
}  // namespace orbwatch::app::modbus
