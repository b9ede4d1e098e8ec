// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/exposure_start.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint kExposureStart(100s);
constexpr auto kExposure = 8ms;
constexpr StampSettings kSettings{.readout_time = 12ms, .offset = 700us};

/// Metadata of a frame whose exposure began at kExposureStart, stamped as `source` states, and
/// delayed by the offset.
FrameMetadata stamped(StampSource source) {
  const bool after_exposure = source != StampSource::ExposureStart;
  const bool after_readout = after_exposure && source != StampSource::ReadoutStart;
  FrameMetadata metadata;
  metadata.stamp_source = source;
  metadata.exposure_time = kExposure;
  metadata.exposure_start = kExposureStart + kSettings.offset +
                            (after_exposure ? kExposure : Clock::duration(0)) +
                            (after_readout ? kSettings.readout_time : Clock::duration(0));
  return metadata;
}

TEST(ExposureStart, IsKnownWhateverTheStampMarks) {
  for (const auto source : {StampSource::ExposureStart, StampSource::ReadoutStart,
                            StampSource::FrameEnd, StampSource::Arrival}) {
    EXPECT_EQ(exposure_start(stamped(source), kSettings), kExposureStart)
        << static_cast<int>(source);
  }
}

TEST(ExposureStart, IsTheStampWhereNothingIsKnown) {
  FrameMetadata metadata{.exposure_start = kExposureStart, .stamp_source = StampSource::FrameEnd};
  EXPECT_EQ(exposure_start(metadata, {}), kExposureStart);
  metadata.stamp_source = StampSource::ReadoutStart;
  EXPECT_EQ(exposure_start(metadata, {}), kExposureStart);
}

}  // namespace
}  // namespace orbwatch::hal
