// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/topics/topic_names.h"

#include <gtest/gtest.h>

namespace orbwatch::app::dds {
namespace {

TEST(TopicNamesTest, AreThoseOfRos2) {
  EXPECT_EQ(image_topic("orbwatch", "front"), "rt/orbwatch/front/image_raw");
  EXPECT_EQ(radiometric_topic("orbwatch", "front"), "rt/orbwatch/front/radiometric/image_raw");
  EXPECT_EQ(image_topic("cell3/orbwatch", kSelectedView), "rt/cell3/orbwatch/selected/image_raw");
  EXPECT_EQ(camera_info_topic(image_topic("orbwatch", "front")), "rt/orbwatch/front/camera_info");
  EXPECT_EQ(camera_info_topic(radiometric_topic("orbwatch", "front")),
            "rt/orbwatch/front/radiometric/camera_info");
  EXPECT_EQ(camera_info_topic(ball_topic("orbwatch", "colour")),
            "rt/orbwatch/colour/ball/camera_info");
  EXPECT_EQ(process_state_topic("orbwatch"), "rt/orbwatch/process_state");
  EXPECT_EQ(event_topic("orbwatch"), "rt/orbwatch/event");
  EXPECT_EQ(command_topic("orbwatch"), "rt/orbwatch/command");
  EXPECT_EQ(command_result_topic("orbwatch"), "rt/orbwatch/command_result");
}

TEST(TopicNamesTest, PartsFollowTheRulesOfRos2) {
  for (const auto* good : {"front", "_a", "A9_b"}) EXPECT_TRUE(check_topic_part(good, "view"));
  for (const auto* bad : {"", "9a", "front-left", "a b", "a/b", "\xC3\xA4", "a*"}) {
    EXPECT_FALSE(check_topic_part(bad, "view")) << bad;
  }
  EXPECT_EQ(check_topic_part("front-left", "view name").error().message,
            "DDS: view name \"front-left\" is not a ROS 2 name; it must be letters, digits and "
            "'_', without a digit first");
}

TEST(TopicNamesTest, PathsHaveSoundParts) {
  for (const auto* good : {"orbwatch", "cell3/orbwatch"}) {
    EXPECT_TRUE(check_topic_path(good, "prefix")) << good;
  }
  for (const auto* bad : {"", "/a", "a/", "a//b", "a/3"}) {
    EXPECT_FALSE(check_topic_path(bad, "prefix")) << bad;
  }
}

}  // namespace
}  // namespace orbwatch::app::dds
