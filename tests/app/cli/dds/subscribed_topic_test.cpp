// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/subscription.h"

#include <gtest/gtest.h>

namespace orbwatch::app::cli {
namespace {

TEST(SubscribedTopic, KnowTheirContent) {
  EXPECT_TRUE(is_process_state_topic("rt/orbwatch/process_state"));
  EXPECT_FALSE(is_process_state_topic("rt/orbwatch/process_state/image_raw"));
}

TEST(SubscribedTopic, AreCompletedAsWritten) {
  for (const auto* written : {"rt/a/b", "/rt/a/b", "a/b", "/a/b"}) {
    EXPECT_EQ(full_topic(written), "rt/a/b") << written;
  }
}

TEST(SubscribedTopic, GiveFileNames) {
  EXPECT_EQ(file_stem("rt/orbwatch/front/image_raw", "orbwatch"), "front");
  EXPECT_EQ(file_stem("rt/orbwatch/front/radiometric/image_raw", "orbwatch"), "front-radiometric");
  EXPECT_EQ(file_stem("rt/cell3/orbwatch/front/image_raw", "cell3/orbwatch"), "front");
  EXPECT_EQ(file_stem("rt/camera/image_raw", "orbwatch"), "camera");
  EXPECT_EQ(file_stem("rt/orbwatch_b/front/image_raw", "orbwatch"), "orbwatch_b-front");
}

TEST(SubscribedTopic, FileNamesStayInTheirFolder) {
  EXPECT_EQ(file_stem("rt/../../etc/passwd", "orbwatch"), "_.-..-etc-passwd");
  EXPECT_EQ(file_stem("rt/.hidden", "orbwatch"), "_hidden");
  EXPECT_EQ(file_stem("rt/a b\n\\c:d", "orbwatch"), "a_b__c_d");
  EXPECT_EQ(file_stem("rt/", "orbwatch"), "image");
  EXPECT_EQ(file_stem("rt//image_raw", "orbwatch"), "image");
}

}  // namespace
}  // namespace orbwatch::app::cli
