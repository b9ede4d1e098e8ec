// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/encoding.h"

#include <gtest/gtest.h>

#include <limits>

namespace orbwatch::app::modbus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Quantity kAngle{"deg", 0.01, -180, 180};

std::int32_t code(double value) { return static_cast<std::int32_t>(encoded(value, kAngle)); }

TEST(Encoding, SignalsAreRoundedAndSigned) {
  EXPECT_EQ(code(0), 0);
  EXPECT_EQ(code(12.344), 1234);
  EXPECT_EQ(code(12.346), 1235);
  EXPECT_EQ(code(-12.344), -1234);
  EXPECT_EQ(code(-12.346), -1235);
}

TEST(Encoding, SignalsStayInTheirRange) {
  EXPECT_EQ(code(180.0000001), 18000);
  EXPECT_EQ(code(1e300), 18000);
  EXPECT_EQ(code(-1e300), -18000);
}

TEST(Encoding, WhatIsNoNumberIsNotValid) {
  EXPECT_EQ(encoded(signals::kNotValid, kAngle), 0x80000000U);
  EXPECT_EQ(encoded(kInfinity, kAngle), 0x80000000U);
  EXPECT_EQ(encoded(-kInfinity, kAngle), 0x80000000U);
}

TEST(Encoding, NoValueInRangeReadsAsNotValid) {
  for (const auto& signal : signals::kSignals) {
    const Quantity quantity{signal.unit, signal.scale, signal.minimum, signal.maximum};
    EXPECT_NE(encoded(signal.minimum, quantity), 0x80000000U) << signal.name;
    EXPECT_NE(encoded(signal.maximum, quantity), 0x80000000U) << signal.name;
    EXPECT_LE(signal.maximum / signal.scale, 0x7fffffff) << signal.name;
    EXPECT_GE(signal.minimum / signal.scale, -0x7fffffff) << signal.name;
  }
}

TEST(Encoding, FiguresStayAtTheirMaximumInsteadOfWrapping) {
  EXPECT_EQ(encoded(29.974, kRate), 2997U);
  EXPECT_EQ(encoded(kRate.maximum, kRate), 10'000'000U);
  EXPECT_EQ(encoded(2 * kRate.maximum, kRate), 10'000'000U);
  EXPECT_EQ(encoded(-1.0, kRate), 0U);
}

TEST(Encoding, AnAgeIsNeverNegative) {
  using std::chrono::milliseconds;
  constexpr auto kNow = hal::TimePoint{} + std::chrono::hours(10'000);
  EXPECT_EQ(age_code(kNow + milliseconds(1), kNow), 0U);
  EXPECT_EQ(age_code(kNow - milliseconds(123), kNow), 123U);
  EXPECT_EQ(age_code(kNow - milliseconds(0x7fffffff), kNow), 0x7fffffffU);
  EXPECT_EQ(age_code(kNow - milliseconds(0x80000000), kNow), 0x7fffffffU);
  EXPECT_EQ(age_code({}, kNow), 0x7fffffffU) << "never";
}

TEST(Encoding, CountersContinueAtZero) {
  constexpr std::uint64_t kLarge = 0x1'0001'ffff;
  EXPECT_EQ(encoded(kLarge, kCount, {}), 0x0001'ffffU);
  EXPECT_EQ(encoded(kLarge + 0xfffe'0001, kCount, {}), 0U);
}

TEST(Encoding, TheTypeFollowsFromTheValue) {
  EXPECT_EQ(type_of<bool>(), Type::Uint);
  EXPECT_EQ(type_of<SystemState>(), Type::Uint);
  EXPECT_EQ(type_of<std::uint16_t>(), Type::Uint);
  EXPECT_EQ(type_of<std::uint32_t>(), Type::Udint);
  EXPECT_EQ(type_of<std::uint64_t>(), Type::Udint);
  EXPECT_EQ(type_of<hal::TimePoint>(), Type::Udint);
  EXPECT_EQ(type_of<double>(), Type::Dint);
}

}  // namespace
}  // namespace orbwatch::app::modbus
