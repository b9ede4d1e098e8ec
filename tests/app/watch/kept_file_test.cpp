// SPDX-License-Identifier: Apache-2.0
#include "app/watch/kept_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

/// Numbers in the names of files that earlier versions kept: an update must find them.
TEST(KeptFile, IsNamedAfterTheOutline) {
  const optics::Outline outline{{400.25, 300.5}, 123.456789012, 123.4, -0.0};
  EXPECT_EQ(kept_file("state", "aligned", "left", outline), "state/aligned-left-df3d8c0e.png");
  EXPECT_NE(kept_file("state", "aligned", "left", {{400.25, 300.5}, 123.5, 123.4, 0}),
            kept_file("state", "aligned", "left", outline));
}

TEST(KeptFile, ReplacesThoseOfItsCameraOnly) {
  const orbwatch::tests::TemporaryFolder folder;
  const cv::Mat pixels(4, 4, CV_8U, cv::Scalar(7));
  const optics::Outline before{{40, 30}, 12, 12, 0}, after{{41, 30}, 12, 12, 0};
  const auto file = [&](const std::string& camera, const optics::Outline& outline) {
    return kept_file(folder.path(), "clean", camera, outline);
  };
  for (const char* camera : {"left", "left-outer"})
    ASSERT_TRUE(keep_file(file(camera, before), pixels));
  ASSERT_TRUE(keep_file(file("left", after), pixels));
  EXPECT_TRUE(std::filesystem::exists(file("left", after)));
  EXPECT_FALSE(std::filesystem::exists(file("left", before)));
  EXPECT_TRUE(std::filesystem::exists(file("left-outer", before)));
}

}  // namespace
}  // namespace orbwatch::app
