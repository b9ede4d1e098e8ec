// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/recordings/recorded_regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/daemon/site/published.h"
#include "tests/app/daemon/demo_site.h"
#include "tests/hal/recording/picture_file.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::daemon {
namespace {

using testing::HasSubstr;

class RecordedRegions : public testing::Test {
 protected:
  /// Writes a recording without messages, with these texts.
  void record(const RecordedTexts& texts) const {
    tests::PictureFile file(recording_);
    for (const auto& [name, text] : texts.files) file.attach(name, text);
    file.finish();
  }

  const orbwatch::tests::TemporaryFolder folder_;
  const std::filesystem::path recording_ = folder_ / "event.mcap";
};

TEST_F(RecordedRegions, AreWhereTheCamerasSeeWhatIsMeasured) {
  const files::Resolved site = demo();
  record(recorded_texts(site, {}));
  const auto recipes = recorded_regions(recording_);
  ASSERT_TRUE(recipes) << recipes.error().message;
  const auto plan = SitePlan::make(site, expected_formats(site));
  ASSERT_TRUE(plan) << plan.error().message;
  const auto measured = measured_recipes(site, *plan);
  const auto balls = camera_balls(site);
  ASSERT_EQ(recipes->size(), measured.size());
  std::size_t corners = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    EXPECT_EQ((*recipes)[i].number, measured[i].number);
    for (const RecordedRegion& region : (*recipes)[i].regions) {
      const auto of_name =
          std::ranges::find(measured[i].regions, region.name, &MeasuredRecipe::Region::name);
      ASSERT_NE(of_name, measured[i].regions.end());
      const auto camera = std::ranges::find(site.names.cameras, region.camera);
      ASSERT_NE(camera, site.names.cameras.end());
      const auto& ball = balls[static_cast<std::size_t>(camera - site.names.cameras.begin())];
      ASSERT_FALSE(region.lines.empty());
      for (const optics::Vec3& corner : of_name->outline) {
        const auto pixel = ball->pixel(optics::normalized(corner));
        ASSERT_TRUE(pixel);
        const auto is_there = [&](const optics::Vec2& drawn) {
          return std::hypot(drawn.u - pixel->u, drawn.v - pixel->v) < 0.5;
        };
        EXPECT_TRUE(std::ranges::any_of(
            region.lines, [&](const auto& line) { return std::ranges::any_of(line, is_there); }));
        ++corners;
      }
    }
  }
  EXPECT_GT(corners, 2U);
}

TEST_F(RecordedRegions, AreThoseOfTheRecordingAlone) {
  EXPECT_FALSE(recorded_regions(recording_)) << "no file";
  record({});
  EXPECT_THAT(recorded_regions(recording_).error().message, HasSubstr("no configuration in it"));
}

TEST_F(RecordedRegions, OfADamagedConfigurationAreRefused) {
  RecordedTexts texts = recorded_texts(demo(), {});
  ASSERT_EQ(texts.files.erase("demo-rig.toml"), 1U);
  record(texts);
  EXPECT_FALSE(recorded_regions(recording_));
}

}  // namespace
}  // namespace orbwatch::app::daemon
