// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/tile_index.h"

#include <algorithm>

#include "app/simulation/tracing/parallel_for.h"

namespace orbwatch::app::simulation {
namespace {

constexpr int kBlock = 32;  // pixels
constexpr int kTile = 8;    // pixels

/// Squares of `size` that cover `whole`; those at its right and lower edge may be smaller.
std::vector<Area> squares(const Area& whole, int size) {
  std::vector<Area> result;
  for (int top = whole.top; top < whole.bottom; top += size) {
    for (int left = whole.left; left < whole.right; left += size) {
      result.push_back(
          {left, top, std::min(left + size, whole.right), std::min(top + size, whole.bottom)});
    }
  }
  return result;
}

}  // namespace

/// Lines of sight of an area.
struct TileIndex::Sights {
  std::vector<Ray> direct, mirrored;

  void add(const Sight& sight) {
    direct.push_back(sight.direct);
    if (sight.on_ball()) mirrored.push_back(sight.mirrored);
  }
  void add(const Sights& more) {
    direct.insert(direct.end(), more.direct.begin(), more.direct.end());
    mirrored.insert(mirrored.end(), more.mirrored.begin(), more.mirrored.end());
  }
  SightBundle bundle() const { return {RayBundle(direct), RayBundle(mirrored)}; }
};

TileIndex::TileIndex(const Pinhole& camera, const Sphere& ball,
                     std::span<const optics::Vec2> points) {
  for (const Area& area : squares({0, 0, camera.width, camera.height}, kBlock)) {
    const std::size_t first = tiles_.size();
    for (const Area& tile : squares(area, kTile)) tiles_.push_back({tile, {}});
    blocks_.push_back({area, first, tiles_.size(), {}});
  }
  parallel_for(static_cast<int>(blocks_.size()), [&](int i) {
    Block& block = blocks_[static_cast<std::size_t>(i)];
    Sights of_block;
    for (std::size_t t = block.first_tile; t < block.end_tile; ++t) {
      Sights of_tile;
      const Area& area = tiles_[t].area;
      for (int v = area.top; v < area.bottom; ++v) {
        for (int u = area.left; u < area.right; ++u) {
          for (const optics::Vec2& point : points) {
            of_tile.add(sight_along(camera.ray_through(u + point.u, v + point.v), ball));
          }
        }
      }
      of_block.add(of_tile);
      tiles_[t].sights = of_tile.bundle();
    }
    block.sights = of_block.bundle();
  });
}

}  // namespace orbwatch::app::simulation
