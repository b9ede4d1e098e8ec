#include "app/modbus/register_values.h"

#include <gtest/gtest.h>

#include <limits>

namespace orbwatch::app::modbus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Quantity kAngle{0.01, "deg", -180, 180};

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
    EXPECT_NE(scaled(signal.minimum, quantity_of(signal)), 0x80000000U) << signal.name;
    EXPECT_NE(scaled(signal.maximum, quantity_of(signal)), 0x80000000U) << signal.name;
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
  constexpr std::uint64_t kLarge = 0x1'0001'ffff;
  EXPECT_EQ(encoded(kLarge, Type::U32, {}), 0x0001'ffffU);
  EXPECT_EQ(encoded(kLarge + 0xfffe'0001, Type::U32, {}), 0U);
  EXPECT_EQ(encoded(kLarge, Type::U16, {}), 0xffffU);
  EXPECT_EQ(encoded(kLarge + 1, Type::U16, {}), 0U);
}

}  // namespace
}  // namespace orbwatch::app::modbus
