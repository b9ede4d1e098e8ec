// SPDX-License-Identifier: Apache-2.0
#include "hal/back_off.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

TEST(BackOff, IsNeverLongerThanTwoSeconds) {
  BackOff pause;
  for (const auto expected : {1s, 2s, 2s}) EXPECT_EQ(pause.next(), expected);
  pause.reset();
  EXPECT_EQ(pause.next(), 1s);
  EXPECT_EQ(pause.next(), 2s);
}

}  // namespace
}  // namespace orbwatch::hal
