// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/returned_buffers.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <thread>

namespace orbwatch::hal {
namespace {

bool is_readable(const ReturnedBuffers& returned) {
  pollfd file{returned.descriptor(), POLLIN, 0};
  return ::poll(&file, 1, 0) == 1;
}

TEST(ReturnedBuffers, IsReadableUntilItIsTaken) {
  ReturnedBuffers returned;
  ASSERT_TRUE(returned.is_open());
  EXPECT_FALSE(is_readable(returned));
  returned.put(0);
  returned.put(31);
  EXPECT_TRUE(is_readable(returned));
  EXPECT_EQ(returned.take(), 0x80000001U);
  EXPECT_FALSE(is_readable(returned));
  EXPECT_EQ(returned.take(), 0U);
  returned.wake();
  EXPECT_TRUE(is_readable(returned));
  EXPECT_EQ(returned.take(), 0U);
}

TEST(ReturnedBuffers, LosesNoneBetweenThreads) {
  ReturnedBuffers returned;
  constexpr int kRounds = 2000;
  std::thread releasing([&] {
    for (int i = 0; i < kRounds; ++i) {
      while (is_readable(returned)) std::this_thread::yield();
      returned.put(static_cast<std::size_t>(i % 2));
    }
  });
  int taken = 0;
  while (taken < kRounds) {
    pollfd file{returned.descriptor(), POLLIN, 0};
    ASSERT_EQ(::poll(&file, 1, 60'000), 1) << "a release was lost after " << taken;
    const std::uint32_t bits = returned.take();
    taken += static_cast<int>(bits & 1U) + static_cast<int>(bits >> 1 & 1U);
  }
  releasing.join();
}

}  // namespace
}  // namespace orbwatch::hal
