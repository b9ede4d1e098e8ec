#include "hal/libcamera/capture_events.h"

#include <gtest/gtest.h>

#include <thread>

namespace orbwatch::hal {
namespace {

const TimePoint kLongAgo{};

TEST(CaptureEvents, GivesNewsOnce) {
  CaptureEvents events;
  events.complete(5);
  events.complete(2);
  events.put_back(0);
  events.put_back(31);
  events.remove_camera();
  events.ring();
  const auto news = events.wait(TimePoint::max());
  ASSERT_EQ(news.completed_count, 2U);
  EXPECT_EQ(news.completed[0], 5);
  EXPECT_EQ(news.completed[1], 2);
  EXPECT_EQ(news.returned, 0x80000001U);
  EXPECT_TRUE(news.removed);
  EXPECT_TRUE(news.rung);
  const auto nothing = events.wait(kLongAgo);
  EXPECT_EQ(nothing.completed_count, 0U);
  EXPECT_EQ(nothing.returned, 0U);
  EXPECT_FALSE(nothing.removed);
  EXPECT_FALSE(nothing.rung);
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
    const auto news = events.wait(TimePoint::max());
    ASSERT_EQ(news.completed_count, 1U);
    ASSERT_EQ(news.completed[0], i % CaptureEvents::kMaxRequests);
    back.put_back(news.completed[0]);
  }
  libcamera.join();
}

}  // namespace
}  // namespace orbwatch::hal
