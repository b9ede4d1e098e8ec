// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/tile_remap.h"

#include <algorithm>
#include <cassert>

#include "proc/remap/colour/yuv420.h"
#include "proc/remap/sampling/plane_map.h"

namespace orbwatch::remap {
namespace {

/// True if a view of that format has its planes in the sampled layout.
bool lies_as_sampled(PixelFormat sampled, PixelFormat view) {
  return sampled == view && view != PixelFormat::Yuyv && view != PixelFormat::Uyvy;
}

int simple_levels(Interpolation interpolation) {
  if (interpolation == Interpolation::Nearest) return 0;
  return interpolation == Interpolation::Bilinear ? kMaxLevel + 1 : 1;
}

/// Distance, in tiles, at which sources and targets are prefetched.
constexpr int kTilesAhead = 4;

bool is_whole(const TileArea& area) { return area.columns == kTile && area.rows == kTile; }

void round_to_pixels(CoordinateTile& coordinates) {
  constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
  for (CoordinateRow& row : coordinates) {
    for (Coordinate& c : row) {
      if (is_defined(c)) c = {(c.u + kHalf) & ~(2 * kHalf - 1), (c.v + kHalf) & ~(2 * kHalf - 1)};
    }
  }
}

}  // namespace

TileRemap::TileRemap(const CoordinateGrid& grid, std::span<const Picture> source,
                     Interpolation interpolation, const Kernel& kernel, SampledPlanes sampled)
    : grid_(grid),
      kernel_(kernel),
      last_level_(static_cast<int>(std::min<std::size_t>(source.size(), kMaxLevel)) - 1),
      format_(source.front().format),
      colour_space_(source.front().colour_space),
      interpolation_(interpolation),
      sampled_(sampled),
      simple_levels_(simple_levels(interpolation)),
      plane_count_(sampled == SampledPlanes::Luminance ? 1 : samplings(format_).count) {
  assert(sampled == SampledPlanes::All || info(format_).colour == ColourModel::Yuv);
  assert(source.front().width == grid.source_width());
  assert(source.front().height == grid.source_height());
  for (std::size_t n = 0; n < plane_count_; ++n) {
    planes_[n] = PlaneSampler(samplings(format_).items[n], source, kernel);
    if (!planes_[n].has_blocks()) simple_levels_ = 0;
  }
}

void TileRemap::write(int tx, int ty, const MutablePicture& out, const TileArea& area) const {
  const bool in_place =
      lies_as_sampled(format_, out.format) && is_whole(area) && sampled_ != SampledPlanes::Yuv420;
  const Targets targets = in_place ? targets_in(out, area.x, area.y) : Targets();
  if (!in_place || !write_simple(tx, ty, targets)) {
    write_other(tx, ty, out, area, in_place ? &targets : nullptr);
  }
}

void TileRemap::write_row(int ty, const MutablePicture& out) const {
  const bool as_sampled = lies_as_sampled(format_, out.format);
  Targets targets = as_sampled ? targets_in(out, 0, ty * kTile) : Targets();
  for (int tx = 0; tx < grid_.tiles_x(); ++tx) {
    if (kernel_.fetches_ahead) {
      fetch(tx + kTilesAhead, ty);
      if (as_sampled && tx % kTilesAhead == 0) fetch_targets(targets, tx);
    }
    const TileArea area = area_of(grid_, tx, ty);
    const bool in_place = as_sampled && is_whole(area);
    if (!in_place || !write_simple(tx, ty, targets)) {
      write_other(tx, ty, out, area, in_place ? &targets : nullptr);
    }
    for (std::size_t n = 0; as_sampled && n < plane_count_; ++n) {
      targets[n].data += planes_[n].tile_bytes();
    }
  }
}

/// Prefetches a tile's source where that part is so large that the processor's own prefetch would
/// be too late, and still fits the cache.
[[gnu::noinline]] void TileRemap::fetch(int tx, int ty) const {
  constexpr int kLeast = 2 * kTile, kMost = 8 * kTile;
  const SourceArea area = grid_.extent(tx, ty);
  const int columns = area.right - area.left, rows = area.bottom - area.top;
  if (area.is_empty() || columns + rows < kLeast || columns > kMost || rows > kMost) return;
  for (std::size_t n = 0; n < plane_count_; ++n) planes_[n].fetch(area);
}

/// Prefetches the targets of kTilesAhead tiles, starting kTilesAhead behind tile tx; together these
/// tiles fill whole cache lines. `targets`: those of tile tx.
[[gnu::noinline]] void TileRemap::fetch_targets(const Targets& targets, int tx) const {
  if (tx + 2 * kTilesAhead > grid_.tiles_x()) return;
  for (std::size_t n = 0; n < plane_count_; ++n) {
    const int bytes = kTilesAhead * planes_[n].tile_bytes();
    const std::uint8_t* row = targets[n].data + bytes;
    for (int y = 0; y < targets[n].rows; ++y, row += targets[n].stride) {
      for (int at = 0; at < bytes; at += kCacheLine) __builtin_prefetch(row + at, 1);
    }
  }
}

/// Writes the most common kind of tile in place; false for another kind.
[[gnu::always_inline]] inline bool TileRemap::write_simple(int tx, int ty,
                                                           const Targets& targets) const {
  const Tile tile = grid_.tile(tx, ty);
  if (!is_patch(tile.kind) || !tile.interior || tile.level >= simple_levels_) return false;
  const Patch patch(grid_.nodes(tile, tx, ty));
  for (std::size_t n = 0; n < plane_count_; ++n) planes_[n].sample_blocks(patch, targets[n]);
  return true;
}

/// `in_place`: the targets of the tile's samples, if the view has the sampled layout.
[[gnu::noinline]] void TileRemap::write_other(int tx, int ty, const MutablePicture& out,
                                              const TileArea& area, const Targets* in_place) const {
  if (is_empty(grid_.tile(tx, ty).kind)) return clear_area(out, area);
  SampledTile sampled;
  const Targets targets = in_place != nullptr ? *in_place : targets_in(sampled);
  const auto convert = [&] {
    if (in_place != nullptr) return;
    switch (sampled_) {
      case SampledPlanes::All:
        return write_tile(sampled, format_, colour_space_, out, area, kernel_);
      case SampledPlanes::Yuv420:
        return write_yuv420(sampled, format_, colour_space_, out, area);
      case SampledPlanes::Luminance:
        return write_luminance(sampled, colour_space_, out, area);
    }
  };
  if (in_place == nullptr && write_simple(tx, ty, targets)) return convert();
  if (sample_smooth(tx, ty, targets)) return convert();
  const CoordinateTile coordinates = sample_pixels(tx, ty, targets);
  convert();
  if (format_ != out.format && sampled_ == SampledPlanes::All)
    clear_undefined(coordinates, out, area);
}

void TileRemap::write_planes(int tx, int ty, PixelFormat order, PlanarTile& out) const {
  SampledTile sampled;
  const Targets targets = targets_in(sampled);
  if (!write_simple(tx, ty, targets) && !sample_smooth(tx, ty, targets)) {
    sample_pixels(tx, ty, targets);
  }
  remap::write_planes(sampled, format_, colour_space_, order, out);
}

/// Samples a tile of any kind pixel by pixel, and returns its coordinates.
[[gnu::noinline]] CoordinateTile TileRemap::sample_pixels(int tx, int ty,
                                                          const Targets& targets) const {
  CoordinateTile coordinates = grid_.pixels(tx, ty);
  if (interpolation_ == Interpolation::Nearest) round_to_pixels(coordinates);
  sample(coordinates, reading(grid_.tile(tx, ty)), targets);
  return coordinates;
}

/// Samples a tile of patches; false for another one, or where places are rounded to pixels.
[[gnu::noinline]] bool TileRemap::sample_smooth(int tx, int ty, const Targets& targets) const {
  if (interpolation_ == Interpolation::Nearest) return false;
  const Tile tile = grid_.tile(tx, ty);
  const Reading reading = this->reading(tile);
  if (is_patch(tile.kind)) {
    sample(Patch(grid_.nodes(tile, tx, ty)), reading, targets);
    return true;
  }
  return grid_.visit_cells(tile, [&](const auto& cells) { sample(cells, reading, targets); });
}

/// The last factor of two is averaged from samples, which keeps more detail than a mip level.
Reading TileRemap::reading(const Tile& tile) const {
  if (tile.level == 0 || !uses_mip_levels(interpolation_)) {
    return {false, 0, tile.interior};
  }
  return {true, std::min(tile.level - 1, last_level_), tile.interior};
}

/// Targets from the pixel (x, y) of the view on.
TileRemap::Targets TileRemap::targets_in(const MutablePicture& out, int x, int y) const {
  Targets targets;
  for (std::size_t n = 0; n < plane_count_; ++n) {
    const PlaneSampler& plane = planes_[n];
    const auto& to = out.planes[plane.sampling().plane];
    targets[n] = {reinterpret_cast<std::uint8_t*>(to.data) +
                      (y >> shift(plane.sampling().y)) * to.stride +
                      std::ptrdiff_t{x >> shift(plane.sampling().x)} * plane.pixel_bytes(),
                  to.stride, plane.columns(), plane.rows()};
  }
  return targets;
}

TileRemap::Targets TileRemap::targets_in(SampledTile& tile) const {
  Targets targets;
  for (std::size_t n = 0; n < plane_count_; ++n) {
    targets[n] = {tile.planes[n].data(), SampledTile::stride(planes_[n].sampling()),
                  planes_[n].columns(), planes_[n].rows()};
  }
  return targets;
}

void TileRemap::sample(const Patch& patch, Reading reading, const Targets& targets) const {
  const Patch map = reading.mip_level > 0 ? on_level(patch, reading.mip_level) : patch;
  for (std::size_t n = 0; n < plane_count_; ++n) {
    planes_[n].sample(map, reading, targets[n]);
  }
}

/// The same for a patch in each cell.
template <int Cell>
void TileRemap::sample(const FineTile<Cell>& cells, Reading reading, const Targets& targets) const {
  Targets parts = targets;
  for (std::size_t n = 0; n < plane_count_; ++n) {
    parts[n].columns /= cells.kCells;
    parts[n].rows /= cells.kCells;
  }
  for (int j = 0; j < cells.kCells; ++j) {
    for (int i = 0; i < cells.kCells; ++i) {
      for (std::size_t n = 0; n < plane_count_; ++n) {
        TargetPlane& part = parts[n];
        part.data = targets[n].data + j * part.rows * part.stride +
                    std::ptrdiff_t{i} * part.columns * planes_[n].pixel_bytes();
      }
      sample(cells.patch(i, j), reading, parts);
    }
  }
}

void TileRemap::sample(const CoordinateTile& coordinates, Reading reading,
                       const Targets& targets) const {
  CoordinateTile scaled;
  if (reading.mip_level > 0) on_level(scaled = coordinates, reading.mip_level);
  const CoordinateTile& places = reading.mip_level > 0 ? scaled : coordinates;
  for (std::size_t n = 0; n < plane_count_; ++n) {
    const std::uint8_t background = black(planes_[n].sampling(), format_, colour_space_);
    planes_[n].sample(places, reading, background, targets[n]);
  }
}

}  // namespace orbwatch::remap
