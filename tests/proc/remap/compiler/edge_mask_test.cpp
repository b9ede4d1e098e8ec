// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/compiler/edge_mask.h"

#include <gtest/gtest.h>

#include <random>

#include "proc/remap/grid/coordinate.h"
#include "tests/proc/optics/random_camera.h"
#include "tests/support/share.h"

namespace orbwatch::remap {
namespace {

using optics::Scene;
using optics::ViewKind;
using optics::ViewProjection;

int surface_at(const ViewProjection& view, const optics::SceneProxy& proxy, int x, int y) {
  const auto direction = view.direction(x, y);
  return direction ? proxy.hit(*direction).surface : -2;
}

// An edge must have been marked between neighbours that show different surfaces.
TEST(EdgeMask, MissesNoChangeOfSurfaceInAnyView) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> angle(-180, 180), share(0, 1);
  const auto proxy = tests::scene_around_ball(Scene::Room::Box, true);
  int changes = 0;
  const int rounds = tests::share_of(25);
  for (int round = 0; round < rounds; ++round) {
    for (const ViewKind kind :
         {ViewKind::Perspective, ViewKind::Equirectangular, ViewKind::Cylindrical,
          ViewKind::Stereographic, ViewKind::Fisheye}) {
      const int width = 60 + static_cast<int>(200 * share(random)), height = 150;
      const auto view = ViewProjection::make({kind,
                                              {angle(random), angle(random), angle(random)},
                                              20 + 150 * share(random),
                                              {},
                                              width,
                                              height})
                            .value();
      const EdgeMask mask = edge_mask(view, proxy.edges());
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const int here = surface_at(view, proxy, x, y);
          if (here == -2) continue;
          const int left = x > 0 ? surface_at(view, proxy, x - 1, y) : here;
          const int above = y > 0 ? surface_at(view, proxy, x, y - 1) : here;
          if (left != here && left != -2) {
            ++changes;
            EXPECT_TRUE(mask.row(x / kTile, y) >> x % kTile & 1)
                << static_cast<int>(kind) << ' ' << x << ' ' << y;
            EXPECT_TRUE(x % kTile == 0 || mask.crosses(x / kTile, y / kTile));
          }
          if (above != here && above != -2 && y % kTile != 0) {
            EXPECT_TRUE(mask.crosses(x / kTile, y / kTile))
                << static_cast<int>(kind) << ' ' << x << ' ' << y;
          }
        }
      }
    }
  }
  EXPECT_GT(changes, rounds * 400);
}

TEST(EdgeMask, MarksALineAndLittleMore) {
  EdgeMask mask(64, 64);
  mask.mark({10.5, -3}, {10.5, 40.3});
  for (int y = 0; y < 64; ++y) {
    EXPECT_EQ(mask.row(0, y), y <= 40 ? 1 << 11 : 0) << y;
    EXPECT_EQ(mask.row(1, y), 0);
  }
  EXPECT_TRUE(mask.crosses(0, 2));
  EXPECT_FALSE(mask.crosses(1, 0));
  EXPECT_FALSE(mask.crosses(0, 3));
}

TEST(EdgeMask, ALineAlongATilesBorderCrossesNoTile) {
  EdgeMask mask(64, 64);
  mask.mark({15.5, 0}, {15.5, 63});
  mask.mark({0, 31.5}, {63, 31.5});
  for (int ty = 0; ty < 4; ++ty) {
    for (int tx = 0; tx < 4; ++tx) EXPECT_FALSE(mask.crosses(tx, ty));
  }
  EXPECT_EQ(mask.row(1, 5), 1);
}

TEST(EdgeMask, IgnoresWhatIsNotInTheView) {
  EdgeMask mask(40, 30);
  mask.mark({-500, -3}, {900, -2});
  mask.mark({1e12, 10}, {1e12, 20});
  mask.mark({-5, 0}, {-5, 29});
  for (int y = 0; y < 30; ++y) {
    for (int tx = 0; tx < 3; ++tx) EXPECT_EQ(mask.row(tx, y), 0);
  }
}

}  // namespace
}  // namespace orbwatch::remap
