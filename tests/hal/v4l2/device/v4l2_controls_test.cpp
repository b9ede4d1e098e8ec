// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/device/v4l2_controls.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

TEST(ControlVariable, IsSpelledAsV4l2CtlDoes) {
  EXPECT_EQ(control_variable("Exposure Time, Absolute"), "exposure_time_absolute");
  EXPECT_EQ(control_variable("White Balance, Automatic"), "white_balance_automatic");
  EXPECT_EQ(control_variable("Gain"), "gain");
  EXPECT_EQ(control_variable("Exposure (Absolute)"), "exposure_absolute");
  EXPECT_EQ(control_variable("exposure_time_absolute"), "exposure_time_absolute");
  EXPECT_EQ(control_variable(""), "");
}

}  // namespace
}  // namespace orbwatch::hal
