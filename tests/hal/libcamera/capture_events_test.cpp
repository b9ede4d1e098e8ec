// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_stream.h"

#include <gtest/gtest.h>

#include <thread>

namespace orbwatch::hal {
namespace {

const TimePoint kLongAgo{};

TEST(CaptureEvents, GivesEventsOnce) {
  CaptureEvents events;
  events.complete(5);
  events.complete(2);
  events.return_buffer(0);
  events.return_buffer(31);
  events.remove_camera();
  events.wake();
  const auto pending = events.wait(TimePoint::max());
  ASSERT_EQ(pending.completed_count, 2U);
  EXPECT_EQ(pending.completed[0], 5);
  EXPECT_EQ(pending.completed[1], 2);
  EXPECT_EQ(pending.returned, 0x80000001U);
  EXPECT_TRUE(pending.removed);
  EXPECT_TRUE(pending.woken);
  const auto nothing = events.wait(kLongAgo);
  EXPECT_EQ(nothing.completed_count, 0U);
  EXPECT_EQ(nothing.returned, 0U);
  EXPECT_FALSE(nothing.removed);
  EXPECT_FALSE(nothing.woken);
}

TEST(CaptureEvents, LosesNoneBetweenThreads) {
  CaptureEvents events;
  CaptureEvents back;
  constexpr std::size_t kRounds = 2000;
  std::thread libcamera([&] {
    for (std::size_t i = 0; i < kRounds; ++i) {
      events.complete(i % CaptureEvents::kMaxRequests);
      while (back.wait(TimePoint::max()).returned == 0) {
      }
    }
  });
  for (std::size_t i = 0; i < kRounds; ++i) {
    const auto pending = events.wait(TimePoint::max());
    ASSERT_EQ(pending.completed_count, 1U);
    ASSERT_EQ(pending.completed[0], i % CaptureEvents::kMaxRequests);
    back.return_buffer(pending.completed[0]);
  }
  libcamera.join();
}

}  // namespace
}  // namespace orbwatch::hal
