#include "hal/v4l2/buffer_stamps.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

TEST(FrameCounter, StartsAtZeroAndShowsGaps) {
  FrameCounter counter;
  EXPECT_EQ(counter.number(17), 0U);
  EXPECT_EQ(counter.number(18), 1U);
  EXPECT_EQ(counter.number(21), 4U);
  EXPECT_EQ(counter.number(22), 5U);
}

TEST(FrameCounter, GoesOnWhereTheDriversCounterWraps) {
  FrameCounter counter;
  EXPECT_EQ(counter.number(UINT32_MAX - 1), 0U);
  EXPECT_EQ(counter.number(UINT32_MAX), 1U);
  EXPECT_EQ(counter.number(0), 2U);
  EXPECT_EQ(counter.number(2), 4U);
}

TEST(FrameCounter, CountsItselfWhenTheDriverDoesNot) {
  FrameCounter counter;
  for (std::uint64_t n = 0; n < 5; ++n) EXPECT_EQ(counter.number(0), n);
}

TEST(FrameCounter, NeverGoesBack) {
  FrameCounter counter;
  EXPECT_EQ(counter.number(100), 0U);
  EXPECT_EQ(counter.number(99), 1U);
  EXPECT_EQ(counter.number(100), 2U);
}

TEST(FrameCounter, FollowsOnWhenTheStreamStartsAnew) {
  FrameCounter counter;
  counter.number(0);
  counter.number(1);
  counter.restart();
  EXPECT_EQ(counter.number(0), 2U);
  EXPECT_EQ(counter.number(3), 5U);
  counter.restart();
  EXPECT_EQ(counter.number(900), 6U);
}

v4l2_buffer stamped(Clock::duration since_boot, std::uint32_t flags) {
  v4l2_buffer buffer{};
  buffer.flags = flags;
  buffer.timestamp.tv_sec = since_boot / 1s;
  buffer.timestamp.tv_usec = since_boot % 1s / 1us;
  return buffer;
}

TEST(ExposureStart, IsTheDriversStampOnTheSteadyClock) {
  const TimePoint arrival{100s};
  EXPECT_EQ(exposure_start(stamped(99s + 750'001us, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC), arrival),
            TimePoint(99s + 750'001us));
  EXPECT_EQ(exposure_start(stamped(99s, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC |
                                            V4L2_BUF_FLAG_TSTAMP_SRC_SOE | V4L2_BUF_FLAG_DONE),
                           arrival),
            TimePoint(99s));
}

TEST(ExposureStart, IsTheArrivalWhenTheStampCannotBe) {
  const TimePoint arrival{100s};
  EXPECT_EQ(exposure_start(stamped(99s, V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN), arrival), arrival);
  EXPECT_EQ(exposure_start(stamped(99s, V4L2_BUF_FLAG_TIMESTAMP_COPY), arrival), arrival);
  EXPECT_EQ(exposure_start(stamped(101s, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC), arrival), arrival);
  EXPECT_EQ(exposure_start(stamped(0s, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC), arrival), arrival);
}

}  // namespace
}  // namespace orbwatch::hal
