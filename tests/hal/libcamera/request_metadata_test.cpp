// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_frame.h"

#include <gtest/gtest.h>
#include <libcamera/control_ids.h>

namespace orbwatch::hal {
namespace {

namespace controls = libcamera::controls;
using namespace std::chrono_literals;

/// Clocks of a machine that ran for 100 s, after a suspend of an hour.
constexpr ClockReading kAfterSleep{TimePoint(100s), 3700s};
constexpr ClockReading kNeverSlept{TimePoint(100s), 100s};

TEST(ToSteady, ConvertsStampsOfTheBootClock) {
  EXPECT_EQ(to_steady(3699s + 900ms, kAfterSleep), TimePoint(99s + 900ms));
  EXPECT_EQ(to_steady(99s + 900ms, kNeverSlept), TimePoint(99s + 900ms));
}

TEST(ToSteady, KeepsStampsOfTheSteadyClock) {
  EXPECT_EQ(to_steady(99s + 900ms, kAfterSleep), TimePoint(99s + 900ms));
}

TEST(ToSteady, RefusesWhatCannotBe) {
  EXPECT_EQ(to_steady(3701s, kAfterSleep), std::nullopt) << "in the future";
  EXPECT_EQ(to_steady(101s, kNeverSlept), std::nullopt) << "in the future";
  EXPECT_EQ(to_steady(0s, kNeverSlept), std::nullopt) << "too old";
  EXPECT_EQ(to_steady(3000s, kAfterSleep), std::nullopt) << "while the machine slept";
}

TEST(ClockReading, IsOfOneMoment) {
  const TimePoint before = Clock::now();
  const ClockReading now = ClockReading::now();
  EXPECT_GE(now.steady, before);
  EXPECT_LE(now.steady, Clock::now());
  EXPECT_GE(now.boot, before.time_since_epoch()) << "the boot clock never lags";
  EXPECT_EQ(to_steady(now.boot, ClockReading::now()).has_value(), true);
}

TEST(MetadataOf, TakesWhatTheRequestSays) {
  libcamera::ControlList request(controls::controls);
  request.set(controls::SensorTimestamp, std::int64_t{99'900'000'000});
  request.set(controls::ExposureTime, 8333);
  request.set(controls::AnalogueGain, 2.0F);
  request.set(controls::DigitalGain, 1.5F);
  request.set(controls::Lux, 420.0F);
  const FrameMetadata metadata = metadata_of(request, 98'000'000'000, kNeverSlept);
  EXPECT_EQ(metadata.exposure_start, TimePoint(99s + 900ms));
  EXPECT_EQ(metadata.stamp_source, StampSource::ReadoutStart);
  EXPECT_EQ(metadata.exposure_time, 8333us);
  EXPECT_DOUBLE_EQ(metadata.gain, 3);
  EXPECT_DOUBLE_EQ(metadata.lux, 420);
}

TEST(MetadataOf, MakesDoWithTheBuffersStampAndThenTheArrival) {
  const libcamera::ControlList request(controls::controls);
  const FrameMetadata metadata = metadata_of(request, 98'000'000'000, kNeverSlept);
  EXPECT_EQ(metadata.exposure_start, TimePoint(98s));
  EXPECT_EQ(metadata.stamp_source, StampSource::FrameEnd);
  EXPECT_EQ(metadata.exposure_time, 0us);
  EXPECT_DOUBLE_EQ(metadata.gain, 1);
  EXPECT_DOUBLE_EQ(metadata.lux, 0);
  for (const std::uint64_t impossible : {std::uint64_t{0}, UINT64_MAX}) {
    const FrameMetadata unstamped = metadata_of(request, impossible, kNeverSlept);
    EXPECT_EQ(unstamped.exposure_start, TimePoint(100s));
    EXPECT_EQ(unstamped.stamp_source, StampSource::Arrival);
  }
}

}  // namespace
}  // namespace orbwatch::hal
