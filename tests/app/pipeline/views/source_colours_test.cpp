// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/source_colours.h"

#include <gtest/gtest.h>

namespace orbwatch::app::pipeline {
namespace {

TEST(SourceColours, CountsOfARadiometricCameraFollowItsScale) {
  hal::StreamFormat format{PixelFormat::Y16, {}, 8, 8, 10};
  EXPECT_DOUBLE_EQ(counts_of(50, format), 32767.5) << "percent of full scale";
  format.kelvin_per_count = 0.1;
  EXPECT_DOUBLE_EQ(counts_of(26.85, format), 3000);
  format.kelvin_offset = 273.15;
  EXPECT_DOUBLE_EQ(counts_of(26.85, format), 268.5);
  EXPECT_DOUBLE_EQ(counts_of(0, format), 0);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
