// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/tags/tag_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/proc/align/place/mirrored_tags.h"
#include "tests/support/picture_of_mat.h"

/// Tags in a ball's picture that is traced by plain vectors.
namespace orbwatch::tests {
namespace {

using align::find_tags;

constexpr int kSide = 520;  ///< a small ball of 235 px: cells of three pixels

struct Pictured {
  TagScene scene;
  cv::Mat pixels;
  optics::Outline outline;
  optics::Lens lens;
};

Pictured pictured(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  TagScene scene = random_tag_scene(random, 230, 240, kSide);
  const RigCamera& camera = scene.rig.cameras[0];
  const SeenLimb limb = limb_of(camera, scene.rig.centre, scene.rig.radius);
  cv::Mat pixels = picture_of_tags(scene.rig, camera, scene.tags, 1, random);
  return {scene,
          pixels,
          {limb.centre, limb.rx, limb.ry, limb.angle},
          optics::Lens::make(camera.lens()).value()};
}

/// Expects each tag, and no tag that is not there.
void expect_found(const Pictured& p, const std::optional<optics::Lens>& lens) {
  const auto found = find_tags(picture_of_mat(p.pixels), p.outline, lens);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->size(), p.scene.tags.size());
  for (const align::FoundTag& tag : *found) {
    const auto truth = std::ranges::find(p.scene.tags, tag.id, &PrintedTag::id);
    ASSERT_NE(truth, p.scene.tags.end());
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 pixel = seen_at(p.scene.rig.cameras[0], p.scene.rig.centre, p.scene.rig.radius,
                                 truth->corners[k]);
      EXPECT_LT(std::hypot(tag.corners[k].u - pixel.u, tag.corners[k].v - pixel.v), 1.2)
          << "tag " << tag.id << ", corner " << k;
    }
  }
}

TEST(TagFinder, FindsTagsWithTheirCornersAsPrinted) {
  const Pictured p = pictured(1);
  expect_found(p, p.lens);
}

TEST(TagFinder, NeedsNoCalibration) { expect_found(pictured(2), std::nullopt); }

TEST(TagFinder, FindsNothingWhereNothingIs) {
  Pictured p = pictured(3);
  p.pixels.setTo(90);
  const auto found = find_tags(picture_of_mat(p.pixels), p.outline, p.lens);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->empty());
}

TEST(TagFinder, RefusesWhatIsNoBall) {
  Pictured p = pictured(3);
  EXPECT_FALSE(find_tags(picture_of_mat(p.pixels(cv::Rect(0, 0, 300, 300))), p.outline, p.lens));
  p.outline.rx = 0;
  EXPECT_FALSE(find_tags(picture_of_mat(p.pixels), p.outline, p.lens));
}

}  // namespace
}  // namespace orbwatch::tests
