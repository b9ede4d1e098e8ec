// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/blend_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "proc/optics/resolution.h"
#include "proc/remap/colour/run_vector.h"
#include "proc/remap/kernel/corner_weights.h"
#include "proc/remap/sampling/tile_remap.h"

namespace orbwatch::remap {
namespace {

/// Width of the fading border as a share of the source picture's shorter side.
constexpr double kFeather = 1.0 / 16;

double fourth_power(double x) { return (x * x) * (x * x); }

/// Smooth step from 0 at t <= 0 to 1 at t >= 1, without a kink.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// 1 within the source picture, decreasing to 0 at its border.
double feather(const optics::Vec2& pixel, const BlendSource& source) {
  const double width = source.source_width, height = source.source_height;
  const double u = pixel.u + 0.5, v = pixel.v + 0.5;
  const double inside = std::min({u, width - u, v, height - v});
  return smooth_step(inside / (kFeather * std::min(width, height)));
}

/// A source's merit in a direction, before sources are weighted against each other.
double merit(const BlendSource& source, const optics::Vec3& direction) {
  const auto pixel = source.ball.pixel(direction);
  if (!pixel) return 0;
  double resolution = optics::resolution(source.ball, direction);
  if (source.enough) resolution = std::min(1.0, resolution / *source.enough);
  return source.weight * fourth_power(resolution) * feather(*pixel, source);
}

/// Shares of 255 in proportion to the merits; 0 where no source has any.
std::array<std::uint8_t, kMaxSources> shares_of(const std::array<double, kMaxSources>& merits) {
  std::array<std::uint8_t, kMaxSources> shares{};
  const double total = std::accumulate(merits.begin(), merits.end(), 0.0);
  if (total <= 0) return shares;
  int rest = UINT8_MAX;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    shares[n] = static_cast<std::uint8_t>(std::lround(merits[n] / total * UINT8_MAX));
    rest -= shares[n];
  }
  // The largest share absorbs the rounding error, where it shows least.
  *std::ranges::max_element(shares) += static_cast<std::uint8_t>(rest);
  return shares;
}

}  // namespace

BlendGrid::BlendGrid(const optics::ViewProjection& view, std::span<const BlendSource> sources)
    : nodes_x_((view.width() + kTile - 1) / kTile + 1) {
  assert(sources.size() <= kMaxSources);
  const int nodes_y = (view.height() + kTile - 1) / kTile + 1;
  shares_.resize(sources.size());
  const std::size_t nodes = static_cast<std::size_t>(nodes_x_) * nodes_y;
  for (auto& shares : shares_) shares.reserve(nodes);
  for (int j = 0; j < nodes_y; ++j) {
    for (int i = 0; i < nodes_x_; ++i) {
      // The last corners lie beyond the view, where a projection may have ended.
      const auto direction = view.direction(std::min(i * kTile, view.width() - 1),
                                            std::min(j * kTile, view.height() - 1));
      std::array<double, kMaxSources> merits{};
      for (std::size_t n = 0; direction && n < sources.size(); ++n) {
        merits[n] = merit(sources[n], *direction);
      }
      if (sources.size() == 1) merits.front() = 1;
      const auto shares = shares_of(merits);
      for (std::size_t n = 0; n < sources.size(); ++n) shares_[n].push_back(shares[n]);
    }
  }
  for (int ty = 0; ty < nodes_y - 1; ++ty) {
    for (int tx = 0; tx < nodes_x_ - 1; ++tx) tiles_.push_back(tile_shares(tx, ty));
  }
}

CornerShares BlendGrid::corners(std::size_t n, int tx, int ty) const {
  const auto above = static_cast<std::size_t>(ty) * nodes_x_ + tx, below = above + nodes_x_;
  const auto& shares = shares_[n];
  return {shares[above], shares[above + 1], shares[below], shares[below + 1]};
}

BlendGrid::TileShares BlendGrid::tile_shares(int tx, int ty) const {
  TileShares tile;
  std::array<int, 4> sums{};
  for (std::size_t n = 0; n < shares_.size(); ++n) {
    const CornerShares shares = corners(n, tx, ty);
    for (std::size_t corner = 0; corner < sums.size(); ++corner) sums[corner] += shares[corner];
    const bool has_share = shares != CornerShares{};
    tile.sharing = static_cast<SourceSet>(tile.sharing | (has_share ? 1U << n : 0U));
  }
  for (const int sum : sums) tile.adds_up &= sum == UINT8_MAX;
  return tile;
}

void BlendGrid::weights(std::size_t n, const CoordinateGrid& grid, int tx, int ty,
                        TileWeights& out) const {
  const Tile tile = grid.tile(tx, ty);
  if (is_empty(tile.kind)) return out.fill(0);
  const auto [a, b, c, d] = corners(n, tx, ty);
  CornerWeights rows(std::array<int, 4>{a, b, c, d});
  for (int y = 0; y < kTile; ++y) {
    const Bytes weights = rows.take_row();
    store(weights == 0 ? Bytes{} + 1 : weights, &out[y * kTile]);
  }
  if (is_defined_throughout(tile.kind)) return;
  const CoordinateTile coordinates = grid.pixels(tx, ty);
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      if (!is_defined(coordinates[y][x])) out[y * kTile + x] = 0;
    }
  }
}

void BlendGrid::weights(std::size_t n, const CoordinateGrid& grid,
                        const ImageView<std::uint8_t>& out) const {
  TileWeights tile;
  for (int ty = 0; ty < grid.tiles_y(); ++ty) {
    for (int tx = 0; tx < grid.tiles_x(); ++tx) {
      weights(n, grid, tx, ty, tile);
      const TileArea area = area_of(grid, tx, ty);
      for (int y = 0; y < area.rows; ++y) {
        std::copy_n(&tile[y * kTile], area.columns, out.at(area.x, area.y + y));
      }
    }
  }
}

std::size_t BlendGrid::bytes() const {
  const std::size_t nodes = shares_.empty() ? 0 : shares_.front().size();
  return shares_.size() * nodes + tiles_.size() * sizeof(TileShares);
}

}  // namespace orbwatch::remap
