// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/controls/libcamera_controls.h"

#include <gtest/gtest.h>

#include <array>

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

/// Metadata that a frame states.
libcamera::ControlList stated(int exposure_time, float gain) {
  libcamera::ControlList metadata(controls::controls);
  metadata.set(controls::ExposureTime, exposure_time);
  metadata.set(controls::AnalogueGain, gain);
  return metadata;
}

TEST(ControlSettings, FindsWhatAFrameStatesOtherwise) {
  const auto offered = offered_controls();
  ControlSettings settings;
  EXPECT_EQ(settings.find_other(stated(500, 1)), nullptr) << "nothing was set";
  ASSERT_TRUE(settings.set(offered, "ExposureTime", 1000));
  ASSERT_TRUE(settings.set(offered, "AnalogueGain", 2));
  EXPECT_EQ(settings.find_other(stated(500, 2)), &controls::ExposureTime);
  EXPECT_EQ(settings.find_other(stated(1000, 1)), &controls::AnalogueGain);
  EXPECT_EQ(settings.find_other(stated(1012, 2.05F)), nullptr) << "rounded to lines and codes";
  EXPECT_EQ(settings.find_other(libcamera::ControlList(controls::controls)), nullptr)
      << "it states nothing";
  ASSERT_TRUE(settings.set(offered, "AeEnable", 1));
  EXPECT_EQ(settings.find_other(stated(500, 1)), nullptr) << "the camera chooses";
}

TEST(ControlSettings, FindsOtherColourGains) {
  const auto offered = offered_controls();
  ControlSettings settings;
  ASSERT_TRUE(settings.set(offered, "ColourGains[0]", 1.5));
  ASSERT_TRUE(settings.set(offered, "ColourGains[1]", 2));
  libcamera::ControlList metadata(controls::controls);
  const std::array<float, 2> same{1.5F, 2};
  metadata.set(controls::ColourGains, libcamera::Span<const float, 2>(same));
  EXPECT_EQ(settings.find_other(metadata), nullptr);
  const std::array<float, 2> other{1.5F, 1};
  metadata.set(controls::ColourGains, libcamera::Span<const float, 2>(other));
  EXPECT_EQ(settings.find_other(metadata), &controls::ColourGains);
}

}  // namespace
}  // namespace orbwatch::hal
