// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "proc/remap/compiler/mip_level.h"
#include "proc/remap/grid/coordinate_grid.h"
#include "tests/proc/remap/grid/grid_scene.h"

// Mip levels of the source that a grid's tiles read.

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;
using optics::ViewSpec;

/// Source pixels between neighbouring pixels in a tile's middle, in the direction with more;
/// nullopt where the exact map ends.
std::optional<double> step_in_the_middle(const CoordinateGrid& grid, const ViewProjection& view,
                                         const BallProjection& ball, int tx, int ty) {
  const double x = (tx + 0.5) * kTile, y = (ty + 0.5) * kTile;
  const auto difference = [&](double dx, double dy) -> std::optional<double> {
    const auto at = [&](double sign) { return view.direction(x + sign * dx, y + sign * dy); };
    const auto a = at(-0.5), b = at(0.5);
    const auto from = a ? ball.pixel(*a) : std::nullopt, to = b ? ball.pixel(*b) : std::nullopt;
    if (!from || !to) return std::nullopt;
    return std::hypot(to->u - from->u, to->v - from->v);
  };
  const auto along = difference(1, 0), down = difference(0, 1);
  if (!along || !down || grid.tile(tx, ty).kind == TileKind::Outside) return std::nullopt;
  return std::max(*along, *down);
}

/// Counts tiles by level. Each must have the level required by the exact map's step in its middle;
/// that may be the neighbouring one where the step is within 3 % of the limit.
std::map<int, int> expect_levels(const ViewSpec& spec, const BallProjection& ball) {
  const auto view = ViewProjection::make(spec).value();
  const CoordinateGrid grid(view, ball, 3000, 3000);
  std::map<int, int> count;
  const auto level = [](double step) {
    return std::clamp(static_cast<int>(std::ceil(0.5 * std::log2(step * step / kLargestStep2))), 0,
                      kMaxLevel);
  };
  for_each_tile(grid, [&](const Tile& tile, int tx, int ty) {
    ++count[tile.level];
    const auto step = step_in_the_middle(grid, view, ball, tx, ty);
    const bool smooth = tile.kind >= TileKind::Patch && tile.kind <= TileKind::CurvedFine;
    if (!step || !smooth) return;
    EXPECT_GE(tile.level, level(*step * 0.97)) << tx << ' ' << ty << ": " << *step;
    EXPECT_LE(tile.level, level(*step * 1.03)) << tx << ' ' << ty << ": " << *step;
  });
  EXPECT_EQ(grid.levels(), count.rbegin()->first);
  return count;
}

TEST(GridLevels, AsksForALevelWhereTheViewIsSmallerThanTheSource) {
  const auto ball =
      centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 3000, 1490);
  // Straight ahead the picture has about 711 px per radian.
  const std::array<std::pair<int, int>, 5> shrunk{{{711, 0}, {302, 1}, {151, 2}, {76, 3}, {38, 3}}};
  for (const auto& [width, level] : shrunk) {
    const double h_fov = 2 * optics::degrees(std::atan(0.5));
    const auto count = expect_levels(
        {ViewKind::Perspective, {0, 0, 0}, h_fov, {}, width, std::min(width, 300)}, ball);
    EXPECT_EQ(count.size(), 1U) << width;
    EXPECT_TRUE(count.contains(level)) << width;
  }
}

TEST(GridLevels, TheLevelFollowsTheLargerStep) {
  const auto ball =
      centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 3000, 1490);
  // The same width as above, a fifth and a tenth of the height.
  const double h_fov = 2 * optics::degrees(std::atan(0.5)), v_fov = h_fov;
  for (const auto& [height, level] : std::array<std::pair<int, int>, 2>{{{151, 2}, {76, 3}}}) {
    for (const double roll : {0.0, 90.0, 30.0}) {
      const auto count =
          expect_levels({ViewKind::Perspective, {0, 0, roll}, h_fov, v_fov, 711, height}, ball);
      EXPECT_TRUE(count.contains(level)) << height << ' ' << roll;
      EXPECT_EQ(count.size(), 1U) << height << ' ' << roll;
    }
  }
  // Levels range from 1 in the middle of the picture to those at its curved border.
  for (const double yaw : {60.0, 120.0, 150.0}) {
    expect_levels({ViewKind::Perspective, {yaw, 10, 20}, 100, {}, 320, 200}, ball);
  }
  expect_levels({ViewKind::Equirectangular, {}, {}, {}, 256, 512}, ball);
}

}  // namespace
}  // namespace orbwatch::remap
