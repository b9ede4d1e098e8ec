// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <random>
#include <utility>

namespace orbwatch::signals {
namespace {

/// The textbook's sums over every value, in extended precision.
Statistics::Figures by_definition(const std::deque<std::pair<double, double>>& values) {
  long double t = 0, v = 0, tt = 0, tv = 0, vv = 0;
  const auto n = static_cast<long double>(values.size());
  for (const auto& [time, value] : values) {
    t += time / n;
    v += value / n;
  }
  for (const auto& [time, value] : values) {
    tt += (time - t) * (time - t);
    tv += (time - t) * (value - v);
    vv += (value - v) * (value - v);
  }
  return {static_cast<double>(v), static_cast<double>(std::sqrt(vv / (n - 1))),
          static_cast<double>(tv / tt)};
}

TEST(Statistics, AreThoseOfTheLastSecondAtAnyFrameRate) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 3);
  for (const double rate : {2.0, 15.0, 30.0, 60.0, 1000.0}) {
    Statistics statistics;
    std::deque<std::pair<double, double>> values;
    for (int i = 0; i < 5 * rate; ++i) {
      const double time = 1e6 + i / rate;  // a clock that has been running for days
      const double value = 2000 + 40 * std::sin(time) + noise(random);
      statistics.add(time, value);
      values.emplace_back(time, value);
      while (values.front().first <= time - 1) values.pop_front();
      if (values.size() < 3 || i < rate) continue;
      const auto expected = by_definition(values), figures = statistics.figures();
      // Above 64 per second the oldest values of up to 1/64 s are removed together.
      const double share = rate > 64 ? 0.05 : 1e-6;
      ASSERT_NEAR(figures.mean, expected.mean, share * expected.deviation + 1e-9) << rate;
      ASSERT_NEAR(figures.deviation, expected.deviation, share * expected.deviation + 1e-9);
      ASSERT_NEAR(figures.trend, expected.trend, share * 20 * expected.deviation + 1e-6);
    }
  }
}

TEST(Statistics, OfALineAreItsSlope) {
  Statistics statistics;
  for (int i = 0; i < 100; ++i) statistics.add(i / 30.0, 5 - 7 * i / 30.0);
  EXPECT_NEAR(statistics.figures().trend, -7, 1e-9);
}

TEST(Statistics, TakeValidValuesOnlyAndForgetThem) {
  Statistics statistics;
  EXPECT_FALSE(is_valid(statistics.figures().mean));
  statistics.add(0, kNotValid);
  EXPECT_FALSE(is_valid(statistics.figures().mean));
  statistics.add(0.1, 4);
  statistics.add(0.2, kNotValid);
  EXPECT_EQ(statistics.figures().mean, 4);
  EXPECT_FALSE(is_valid(statistics.figures().deviation));
  EXPECT_FALSE(is_valid(statistics.figures().trend));
  statistics.add(0.3, 6);
  EXPECT_EQ(statistics.figures().mean, 5);
  EXPECT_NEAR(statistics.figures().trend, 10, 1e-9);
  statistics.add(1.2, kNotValid);
  EXPECT_EQ(statistics.figures().mean, 6) << "the first one is more than a second ago";
  statistics.add(2, kNotValid);
  EXPECT_FALSE(is_valid(statistics.figures().mean));
  statistics.add(2.1, 1);
  statistics.reset();
  EXPECT_FALSE(is_valid(statistics.figures().mean));
}

}  // namespace
}  // namespace orbwatch::signals
