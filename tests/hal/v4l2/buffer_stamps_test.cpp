#include "hal/v4l2/buffer_stamps.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

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
