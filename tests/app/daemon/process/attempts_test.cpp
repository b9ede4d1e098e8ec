// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/process/attempts.h"

#include <gmock/gmock.h>

namespace orbwatch::app::daemon {
namespace {

using std::chrono::seconds;
using testing::ElementsAre;

constexpr hal::TimePoint kStart{std::chrono::hours(1)};

TEST(Attempts, AreMadeAgainAfterAtMostTwoSecondsUntilTheySucceed) {
  Attempts attempts;
  std::vector<hal::Clock::duration> made;
  hal::TimePoint now = kStart;
  const auto comes_at = [&](hal::TimePoint moment) {
    return [&, moment]() -> Result<> {
      made.push_back(now - kStart);
      if (now < moment) return fail("not there");
      return {};
    };
  };
  attempts.add("camera", comes_at(kStart + seconds(6)), now);
  while (attempts.due() != hal::TimePoint::max()) {
    now = attempts.due();
    attempts.run(now);
  }
  EXPECT_THAT(made, ElementsAre(seconds(0), seconds(1), seconds(3), seconds(5), seconds(7)));
}

TEST(Attempts, NeitherWaitForEachOtherNorAreMadeEarly) {
  Attempts attempts;
  int first = 0, second = 0;
  attempts.add(
      "first", [&]() -> Result<> { return ++first, fail("no"); }, kStart);
  attempts.add(
      "second", [&]() -> Result<> { return ++second, fail("no"); }, kStart + seconds(10));
  attempts.run(kStart + seconds(10));
  EXPECT_EQ(first, 2);
  EXPECT_EQ(second, 1) << "it is due a second later";
  EXPECT_EQ(attempts.due(), kStart + seconds(11));
}

TEST(Attempts, WhatIsThereAtOnceIsNotTriedAgain) {
  Attempts attempts;
  attempts.add(
      "modbus", [] { return Result<>(); }, kStart);
  EXPECT_EQ(attempts.due(), hal::TimePoint::max());
}

}  // namespace
}  // namespace orbwatch::app::daemon
