// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/v4l2_stream.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

FilledBuffer stamped(Clock::duration since_boot, std::uint32_t flags) {
  FilledBuffer buffer;
  buffer.flags = flags;
  buffer.timestamp.tv_sec = since_boot / 1s;
  buffer.timestamp.tv_usec = since_boot % 1s / 1us;
  return buffer;
}

TEST(FrameStamp, IsTheDriversOnTheSteadyClock) {
  const TimePoint arrival{100s};
  const auto end =
      frame_stamp(stamped(99s + 750'001us, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC), arrival);
  EXPECT_EQ(end.moment, TimePoint(99s + 750'001us));
  EXPECT_EQ(end.source, StampSource::FrameEnd);
  const auto start =
      frame_stamp(stamped(99s, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE |
                                   V4L2_BUF_FLAG_DONE),
                  arrival);
  EXPECT_EQ(start.moment, TimePoint(99s));
  EXPECT_EQ(start.source, StampSource::ExposureStart);
}

TEST(FrameStamp, IsTheArrivalWhenTheDriversCannotBe) {
  const TimePoint arrival{100s};
  for (const FilledBuffer& buffer :
       {stamped(99s, V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN), stamped(99s, V4L2_BUF_FLAG_TIMESTAMP_COPY),
        stamped(101s, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC),
        stamped(0s, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)}) {
    const auto stamp = frame_stamp(buffer, arrival);
    EXPECT_EQ(stamp.moment, arrival);
    EXPECT_EQ(stamp.source, StampSource::Arrival);
  }
}

}  // namespace
}  // namespace orbwatch::hal
