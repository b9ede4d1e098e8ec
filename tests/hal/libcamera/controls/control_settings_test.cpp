#include "hal/libcamera/controls/libcamera_controls.h"

#include <gtest/gtest.h>

#include "tests/hal/libcamera/offered_controls.h"

namespace orbwatch::hal {
namespace {

namespace controls = libcamera::controls;

TEST(ControlSettings, GiveARequestWhatChangedAndAStartEverything) {
  const auto offered = offered_controls();
  ControlSettings settings;
  ASSERT_TRUE(settings.set(offered, "ExposureTime", 1000));
  ASSERT_TRUE(settings.set(offered, "Gain", 2));

  libcamera::ControlList first(controls::controls);
  settings.add_changes(first);
  EXPECT_EQ(first.get(controls::ExposureTime), 1000);
  EXPECT_EQ(first.get(controls::AnalogueGain), 2.0F);

  ASSERT_TRUE(settings.set(offered, "ExposureTime", 2000));
  EXPECT_FALSE(settings.set(offered, "ExposureTime", -1)) << "changes nothing";
  libcamera::ControlList second(controls::controls);
  settings.add_changes(second);
  EXPECT_EQ(second.size(), 1U);
  EXPECT_EQ(second.get(controls::ExposureTime), 2000);

  libcamera::ControlList third(controls::controls);
  settings.add_changes(third);
  EXPECT_TRUE(third.empty());

  const auto start = settings.all();
  EXPECT_EQ(start.get(controls::ExposureTime), 2000);
  EXPECT_EQ(start.get(controls::AnalogueGain), 2.0F);
}

TEST(ControlSettings, AreNotSentAgainAfterAStart) {
  ControlSettings settings;
  ASSERT_TRUE(settings.set(offered_controls(), "AeEnable", 0));
  EXPECT_EQ(settings.all().size(), 1U);
  libcamera::ControlList request(controls::controls);
  settings.add_changes(request);
  EXPECT_TRUE(request.empty());
}

}  // namespace
}  // namespace orbwatch::hal
