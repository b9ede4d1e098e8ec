#include "hal/back_off.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

TEST(BackOff, DoublesUpToTenSecondsUntilItIsReset) {
  BackOff pause;
  for (const auto expected : {1s, 2s, 4s, 8s, 10s, 10s}) EXPECT_EQ(pause.next(), expected);
  pause.reset();
  EXPECT_EQ(pause.next(), 1s);
  EXPECT_EQ(pause.next(), 2s);
}

}  // namespace
}  // namespace orbwatch::hal
