// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/file_descriptor.h"

#include <gtest/gtest.h>
#include <poll.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

bool is_readable(const EventFd& event) {
  pollfd file{event.get(), POLLIN, 0};
  return ::poll(&file, 1, 0) == 1;
}

TEST(EventFd, IsReadableFromSignalToClear) {
  const EventFd event;
  ASSERT_TRUE(event.is_open());
  EXPECT_FALSE(is_readable(event));
  event.signal();
  event.signal();
  EXPECT_TRUE(is_readable(event));
  event.clear();
  EXPECT_FALSE(is_readable(event));
  event.clear();
  EXPECT_FALSE(is_readable(event));
}

TEST(PollTimeout, IsRoundedUpAndBounded) {
  EXPECT_EQ(poll_timeout(TimePoint::min()), 0);
  EXPECT_EQ(poll_timeout(Clock::now()), 0);
  EXPECT_EQ(poll_timeout(TimePoint::max()), 60'000);
  const int soon = poll_timeout(Clock::now() + 10s);
  EXPECT_GT(soon, 5'000);
  EXPECT_LE(soon, 10'000);
}

}  // namespace
}  // namespace orbwatch::hal
