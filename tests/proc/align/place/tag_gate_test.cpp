// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>

#include "proc/align/place/tags/tag_finder.h"
#include "tests/proc/align/place/mirrored_tags.h"
#include "tests/support/error_distribution.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/share.h"

/// Cameras placed by printed tags alone: four tags of 120 mm, 6 to 10 ball radii away.
namespace orbwatch::tests {
namespace {

using align::BallCentre;

/// The request with the corners as marks; nullopt for a tag that is not there.
std::optional<align::PlaceRequest> request_by_tags(const TagScene& scene,
                                                   const std::vector<align::FoundTag>& found,
                                                   std::mt19937_64& random) {
  align::PlaceRequest request =
      request_of(scene.rig, {}, BallCentre::Knowledge::Known, false, random);
  request.points.clear();
  request.cameras[0].marks.clear();
  for (const align::FoundTag& tag : found) {
    const auto printed = std::ranges::find(scene.tags, tag.id, &PrintedTag::id);
    if (printed == scene.tags.end()) return std::nullopt;
    for (std::size_t k = 0; k < 4; ++k) {
      request.cameras[0].marks.push_back({request.points.size(), tag.corners[k]});
      request.points.push_back(printed->corners[k]);
    }
  }
  return request;
}

TEST(TagGate, PlacesCamerasByTagsAlone) {
  const int rigs = share_of(40);
  ErrorDistribution corners("tag corners, px"), error("placed by tags, deg");
  ErrorDistribution ratio("placed by tags, error / claimed");
  int missed = 0;
  for (int n = 0; n < rigs; ++n) {
    std::mt19937_64 random(60'000 + std::uint64_t(n));
    const TagScene scene = random_tag_scene(random, 500, 620, 1400);
    const RigCamera& camera = scene.rig.cameras[0];
    const cv::Mat picture = picture_of_tags(scene.rig, camera, scene.tags, 2, random);
    auto request = request_by_tags(scene, {}, random);
    ASSERT_TRUE(request);
    const auto found = align::find_tags(picture_of_mat(picture), request->cameras[0].outline,
                                        optics::Lens::make(camera.lens()).value());
    ASSERT_TRUE(found) << found.error().message;
    missed += 4 - int(found->size());
    request = request_by_tags(scene, *found, random);
    ASSERT_TRUE(request) << "rig " << n << ": a tag that is not there";
    for (std::size_t m = 0; m < request->points.size(); ++m) {
      const Vec2 truth = seen_at(camera, scene.rig.centre, scene.rig.radius, request->points[m]);
      const Vec2& mark = request->cameras[0].marks[m].pixel;
      corners.add(std::hypot(mark.u - truth.u, mark.v - truth.v));
    }
    const auto placed = align::place(*request);
    if (!placed) std::printf("rig %d: %s\n", n, placed.error().message.c_str());
    if (!placed) continue;
    error.add(direction_error(scene.rig, 0, *placed));
    ratio.add(direction_error(scene.rig, 0, *placed) / placed->cameras[0].direction_sigma);
  }
  corners.report();
  error.report();
  ratio.report();
  std::printf("%d of %d tags missed\n", missed, 4 * rigs);
  RecordProperty("missed", missed);
  EXPECT_LE(missed, std::max(1.0, 0.03 * 4 * rigs));
  EXPECT_EQ(error.size(), std::size_t(rigs));
  EXPECT_LT(corners.p50(), 0.3);
  EXPECT_LT(error.p50(), 0.1);
  EXPECT_LT(error.p95(), 0.25);
  EXPECT_LT(ratio.p95(), 2);
}

}  // namespace
}  // namespace orbwatch::tests
