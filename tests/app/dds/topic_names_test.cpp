#include "app/dds/topic_names.h"

#include <gtest/gtest.h>

namespace orbwatch::app {
namespace {

TEST(TopicNamesTest, AreThoseOfRos2) {
  EXPECT_EQ(image_topic("orbwatch", "front"), "rt/orbwatch/front/image_raw");
  EXPECT_EQ(radiometric_topic("orbwatch", "front"), "rt/orbwatch/front/radiometric/image_raw");
  EXPECT_EQ(image_topic("cell3/orbwatch", kSelectedView), "rt/cell3/orbwatch/selected/image_raw");
  EXPECT_EQ(process_state_topic("orbwatch"), "rt/orbwatch/process_state");
  EXPECT_EQ(event_topic("orbwatch"), "rt/orbwatch/event");
  EXPECT_EQ(command_topic("orbwatch"), "rt/orbwatch/command");
  EXPECT_EQ(command_result_topic("orbwatch"), "rt/orbwatch/command_result");
}

TEST(TopicNamesTest, KnowTheirContent) {
  EXPECT_TRUE(is_process_state_topic("rt/orbwatch/process_state"));
  EXPECT_FALSE(is_process_state_topic("rt/orbwatch/process_state/image_raw"));
}

TEST(TopicNamesTest, AreCompletedAsWritten) {
  for (const auto* written : {"rt/a/b", "/rt/a/b", "a/b", "/a/b"}) {
    EXPECT_EQ(full_topic(written), "rt/a/b") << written;
  }
}

TEST(TopicNamesTest, PartsFollowTheRulesOfRos2) {
  for (const auto* good : {"front", "_a", "A9_b"}) EXPECT_TRUE(check_topic_part(good, "view"));
  for (const auto* bad : {"", "9a", "front-left", "a b", "a/b", "\xC3\xA4", "a*"}) {
    EXPECT_FALSE(check_topic_part(bad, "view")) << bad;
  }
  EXPECT_EQ(
      check_topic_part("front-left", "view name").error().message,
      "DDS: view name \"front-left\" is no ROS 2 name: letters, digits and '_', no digit first");
}

TEST(TopicNamesTest, PathsHaveSoundParts) {
  for (const auto* good : {"orbwatch", "cell3/orbwatch"}) {
    EXPECT_TRUE(check_topic_path(good, "prefix")) << good;
  }
  for (const auto* bad : {"", "/a", "a/", "a//b", "a/3"}) {
    EXPECT_FALSE(check_topic_path(bad, "prefix")) << bad;
  }
}

TEST(TopicNamesTest, GiveFileNames) {
  EXPECT_EQ(file_stem("rt/orbwatch/front/image_raw", "orbwatch"), "front");
  EXPECT_EQ(file_stem("rt/orbwatch/front/radiometric/image_raw", "orbwatch"), "front-radiometric");
  EXPECT_EQ(file_stem("rt/cell3/orbwatch/front/image_raw", "cell3/orbwatch"), "front");
  EXPECT_EQ(file_stem("rt/camera/image_raw", "orbwatch"), "camera");
  EXPECT_EQ(file_stem("rt/orbwatch_b/front/image_raw", "orbwatch"), "orbwatch_b-front");
}

TEST(TopicNamesTest, FileNamesStayInTheirFolder) {
  EXPECT_EQ(file_stem("rt/../../etc/passwd", "orbwatch"), "_.-..-etc-passwd");
  EXPECT_EQ(file_stem("rt/.hidden", "orbwatch"), "_hidden");
  EXPECT_EQ(file_stem("rt/a b\n\\c:d", "orbwatch"), "a_b__c_d");
  EXPECT_EQ(file_stem("rt/", "orbwatch"), "image");
  EXPECT_EQ(file_stem("rt//image_raw", "orbwatch"), "image");
}

}  // namespace
}  // namespace orbwatch::app
