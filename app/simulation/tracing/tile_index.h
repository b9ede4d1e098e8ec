// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "app/simulation/scene/moving_things.h"
#include "app/simulation/tracing/pinhole.h"
#include "app/simulation/tracing/ray_bundle.h"

namespace orbwatch::app::simulation {

/// Pixels from `left` and `top` to below `right` and `bottom`.
struct Area {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

/// Finds the parts of a picture in which a moving object may be visible, without tracing rays:
/// blocks of tiles of pixels, each with the ray bundles of its lines of sight. Immutable;
/// reentrant.
class TileIndex {
 public:
  /// `points`: a pixel's sampling points, relative to its centre.
  TileIndex(const Pinhole& camera, const Sphere& ball, std::span<const optics::Vec2> points);

  /// Calls redraw(const Area&, const SightCandidates&) for every tile with a candidate.
  template <class Redraw>
  void for_each_touched(const MovingThings& things, const Redraw& redraw) const {
    const Candidates all = things.everything();
    for (const Block& block : blocks_) {
      const SightCandidates in_block = block.sights.meeting(things, {all, all});
      if (in_block.empty()) continue;
      for (std::size_t i = block.first_tile; i < block.end_tile; ++i) {
        const SightCandidates in_tile = tiles_[i].sights.meeting(things, in_block);
        if (!in_tile.empty()) redraw(tiles_[i].area, in_tile);
      }
    }
  }

 private:
  struct SightBundle {
    RayBundle direct;
    RayBundle mirrored;

    SightCandidates meeting(const MovingThings& things, const SightCandidates& among) const {
      return {things.meeting(direct, among.direct), things.meeting(mirrored, among.mirrored)};
    }
  };
  struct Sights;
  struct Tile {
    Area area;
    SightBundle sights;
  };
  struct Block {
    Area area;
    std::size_t first_tile = 0;
    std::size_t end_tile = 0;
    SightBundle sights;
  };

  std::vector<Block> blocks_;
  std::vector<Tile> tiles_;
};

}  // namespace orbwatch::app::simulation
