// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/mailbox.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace orbwatch::hal {
namespace {

TEST(Doorbell, KeepsRingsUntilSomebodyWaits) {
  Doorbell bell;
  bell.ring();
  bell.ring();
  bell.wait();  // without both rings this never ends
}

TEST(Doorbell, LosesNoRing) {
  Doorbell ask, answer;
  constexpr int kTimes = 20000;
  std::atomic<int> asked = 0;
  std::thread waiter([&] {
    for (int i = 1; i <= kTimes; ++i) {
      ask.wait();
      ASSERT_EQ(asked, i);
      answer.ring();
    }
  });
  for (int i = 0; i < kTimes; ++i) {
    ++asked;
    ask.ring();
    answer.wait();
  }
  waiter.join();
}

}  // namespace
}  // namespace orbwatch::hal
