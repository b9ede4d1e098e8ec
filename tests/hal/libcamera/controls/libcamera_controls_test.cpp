// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/controls/libcamera_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/hal/libcamera/offered_controls.h"

namespace orbwatch::hal {
namespace {

namespace controls = libcamera::controls;
using testing::AllOf;
using testing::HasSubstr;

class PutControl : public testing::Test {
 protected:
  std::string error(std::string_view name, double value) {
    const std::size_t before = list.size();
    const auto done = put_control(offered, name, value, list);
    EXPECT_EQ(list.size(), before) << "a refused control is not sent";
    return done ? std::string() : done.error().message;
  }

  const libcamera::ControlInfoMap offered = offered_controls();
  libcamera::ControlList list{controls::controls};
};

TEST_F(PutControl, TakesLibcamerasNamesAndTypes) {
  ASSERT_TRUE(put_control(offered, "ExposureTime", 999.6, list));
  EXPECT_EQ(list.get(controls::ExposureTime), 1000);
  ASSERT_TRUE(put_control(offered, "AnalogueGain", 1.5, list));
  EXPECT_EQ(list.get(controls::AnalogueGain), 1.5F);
  ASSERT_TRUE(put_control(offered, "AeEnable", 0, list));
  EXPECT_EQ(list.get(controls::AeEnable), false);
  ASSERT_TRUE(put_control(offered, "AwbEnable", 1, list));
  EXPECT_EQ(list.get(controls::AwbEnable), true);
  ASSERT_TRUE(put_control(offered, "LensPosition", 0.25, list));
  EXPECT_EQ(list.get(controls::LensPosition), 0.25F);
}

TEST_F(PutControl, TakesGenicamNames) {
  ASSERT_TRUE(put_control(offered, "Gain", 4, list));
  EXPECT_EQ(list.get(controls::AnalogueGain), 4.0F);
  ASSERT_TRUE(put_control(offered, "ExposureAuto", 1, list));
  EXPECT_EQ(list.get(controls::AeEnable), true);
  ASSERT_TRUE(put_control(offered, "BalanceWhiteAuto", 0, list));
  EXPECT_EQ(list.get(controls::AwbEnable), false);
}

TEST_F(PutControl, SetsOneColourGainAndKeepsTheOther) {
  ASSERT_TRUE(put_control(offered, "ColourGains[1]", 1.5, list));
  auto gains = list.get(controls::ColourGains);
  ASSERT_TRUE(gains);
  EXPECT_EQ((*gains)[0], 1.0F);
  EXPECT_EQ((*gains)[1], 1.5F);
  ASSERT_TRUE(put_control(offered, "ColourGains[0]", 2.25, list));
  gains = list.get(controls::ColourGains);
  EXPECT_EQ((*gains)[0], 2.25F);
  EXPECT_EQ((*gains)[1], 1.5F);
  EXPECT_THAT(error("ColourGains[0]", 33), HasSubstr("0 to 32"));
  EXPECT_THAT(error("ColourGains", 2), HasSubstr("ColourGains[0]"));
  EXPECT_THAT(error("ColourGains[2]", 2), HasSubstr("no control"));
}

TEST_F(PutControl, RefusesWhatIsOutOfRange) {
  EXPECT_THAT(error("ExposureTime", 74), AllOf(HasSubstr("74"), HasSubstr("75 to")));
  EXPECT_THAT(error("ExposureTime", 1e12), HasSubstr("ExposureTime"));
  EXPECT_THAT(error("AnalogueGain", 10.6), HasSubstr("1 to 10.5"));
  EXPECT_THAT(error("AeEnable", 2), HasSubstr("0 to 1"));
  EXPECT_THAT(error("LensPosition", std::numeric_limits<double>::quiet_NaN()),
              HasSubstr("LensPosition"));
  EXPECT_THAT(error("Saturation", std::numeric_limits<double>::infinity()),
              HasSubstr("Saturation"));
}

TEST_F(PutControl, ListsWhatThereIs) {
  EXPECT_THAT(error("Zoom", 1),
              AllOf(HasSubstr("no control \"Zoom\""), HasSubstr("AeEnable, AnalogueGain, AwbEna")));
  EXPECT_THAT(error("ScalerCrop", 1), HasSubstr("does not take a number"));
  EXPECT_THAT(error("FrameDurationLimits", 33333), HasSubstr("more than one number"));
}

TEST(ListControls, NamesAllThatCanBePutWithWhatTheyTake) {
  const libcamera::ControlInfoMap offered = offered_controls();
  const std::vector<CameraControl> controls = list_controls(offered);
  std::vector<std::string> names;
  libcamera::ControlList list(libcamera::controls::controls);
  for (const CameraControl& control : controls) {
    names.push_back(control.name);
    EXPECT_TRUE(put_control(offered, control.name, control.minimum, list)) << control.name;
    EXPECT_TRUE(put_control(offered, control.name, control.maximum, list)) << control.name;
    EXPECT_FALSE(put_control(offered, control.name, control.maximum + 1, list)) << control.name;
  }
  EXPECT_THAT(names,
              testing::ElementsAre("AeEnable", "AnalogueGain", "AwbEnable", "ColourGains[0]",
                                   "ColourGains[1]", "ExposureTime", "LensPosition", "Saturation"));
  EXPECT_EQ(controls[1].minimum, 1);
  EXPECT_EQ(controls[1].maximum, 10.5);
  EXPECT_EQ(controls[1].step, 0);
  EXPECT_EQ(controls[5].step, 1);
  EXPECT_EQ(controls[6].default_value, 1);
}

}  // namespace
}  // namespace orbwatch::hal
