#include "proc/remap/tile_remap.h"

#include <algorithm>
#include <cassert>

#include "proc/remap/plane_map.h"

namespace orbwatch::remap {
namespace {

/// A view of that format has its planes as they are sampled.
bool lies_as_sampled(PixelFormat sampled, PixelFormat view) {
  return sampled == view && view != PixelFormat::Yuyv && view != PixelFormat::Uyvy;
}

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
                     Interpolation interpolation, const Kernel& kernel)
    : grid_(grid),
      most_halves_(static_cast<int>(std::min<std::size_t>(source.size(), kMaxLevel)) - 1),
      format_(source.front().format),
      colour_space_(source.front().colour_space),
      interpolation_(interpolation),
      plane_count_(samplings(format_).count) {
  assert(source.front().width == grid.source_width());
  assert(source.front().height == grid.source_height());
  for (std::size_t n = 0; n < plane_count_; ++n) {
    planes_[n] = PlaneSampler(samplings(format_).items[n], source, kernel);
  }
}

void TileRemap::write(int tx, int ty, const MutablePicture& out, const TileArea& area) const {
  const bool in_place = lies_as_sampled(format_, out.format);
  const Targets targets = in_place ? targets_in(out, area.x, area.y) : Targets();
  write_tile_at(tx, ty, out, area, in_place ? &targets : nullptr);
}

void TileRemap::write_row(int ty, const MutablePicture& out) const {
  const bool in_place = lies_as_sampled(format_, out.format);
  Targets targets = in_place ? targets_in(out, 0, ty * kTile) : Targets();
  for (int tx = 0; tx < grid_.tiles_x(); ++tx) {
    write_tile_at(tx, ty, out, area_of(grid_, tx, ty), in_place ? &targets : nullptr);
    for (std::size_t n = 0; in_place && n < plane_count_; ++n) {
      targets[n].data += planes_[n].tile_bytes();
    }
  }
}

/// `in_place`: where the samples of a whole tile go, if they lie in the view as they are sampled.
[[gnu::always_inline]] inline void TileRemap::write_tile_at(int tx, int ty,
                                                            const MutablePicture& out,
                                                            const TileArea& area,
                                                            const Targets* in_place) const {
  const Tile tile = grid_.tile(tx, ty);
  if (tile.kind == TileClass::Blind || tile.kind == TileClass::Outside) {
    return clear_area(out, area);
  }
  const Reading reading = this->reading(tile);
  if (interpolation_ == Interpolation::Nearest) return write_dense(tx, ty, reading, out, area);
  if (area.columns < kTile || area.rows < kTile) in_place = nullptr;
  if (tile.kind == TileClass::Patch) {
    Patch patch(grid_.nodes(tile, tx, ty));
    if (reading.halves > 0) patch = on_level(patch, reading.halves);
    return in_place != nullptr ? sample(patch, reading, *in_place)
                               : write_converted(patch, reading, out, area);
  }
  if (!write_cells(tile, reading, out, area, in_place)) write_dense(tx, ty, reading, out, area);
}

/// The last factor of two is left to samples, which keeps more detail than a half of the picture.
Reading TileRemap::reading(const Tile& tile) const {
  if (tile.level == 0 || interpolation_ != Interpolation::Area) {
    return {Reading::kPlain, tile.interior};
  }
  return {std::min(tile.level - 1, most_halves_), tile.interior};
}

/// From the pixel (x, y) of the view on.
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

[[gnu::always_inline]] inline void TileRemap::sample(const Patch& patch, Reading reading,
                                                     const Targets& targets) const {
  for (std::size_t n = 0; n < plane_count_; ++n) planes_[n].sample(patch, reading, targets[n]);
}

/// The same for a patch in each cell.
template <int Cell>
void TileRemap::sample(const FineTile<Cell>& cells, Reading reading, const Targets& targets) const {
  for (int j = 0; j < cells.kCells; ++j) {
    for (int i = 0; i < cells.kCells; ++i) {
      Targets parts = targets;
      for (std::size_t n = 0; n < plane_count_; ++n) {
        TargetPlane& part = parts[n];
        part.columns /= cells.kCells;
        part.rows /= cells.kCells;
        part.data += j * part.rows * part.stride +
                     std::ptrdiff_t{i} * part.columns * planes_[n].pixel_bytes();
      }
      Patch patch = cells.patch(i, j);
      if (reading.halves > 0) patch = on_level(patch, reading.halves);
      sample(patch, reading, parts);
    }
  }
}

[[gnu::noinline]] void TileRemap::write_converted(const Patch& patch, Reading reading,
                                                  const MutablePicture& out,
                                                  const TileArea& area) const {
  SampledTile sampled;
  sample(patch, reading, targets_in(sampled));
  write_tile(sampled, format_, colour_space_, out, area);
}

/// False if the tile is not kept in cells.
[[gnu::noinline]] bool TileRemap::write_cells(const Tile& tile, Reading reading,
                                              const MutablePicture& out, const TileArea& area,
                                              const Targets* in_place) const {
  // Where a map bends it is steep: without means hardly a cell fits windows.
  if (reading.halves == Reading::kPlain) reading.in_windows = false;
  return grid_.take_cells(tile, [&](const auto& cells) {
    if (in_place != nullptr) return sample(cells, reading, *in_place);
    SampledTile sampled;
    sample(cells, reading, targets_in(sampled));
    write_tile(sampled, format_, colour_space_, out, area);
  });
}

[[gnu::noinline]] void TileRemap::write_dense(int tx, int ty, Reading reading,
                                              const MutablePicture& out,
                                              const TileArea& area) const {
  CoordinateTile coordinates = grid_.pixels(tx, ty);
  if (interpolation_ == Interpolation::Nearest) round_to_pixels(coordinates);
  if (reading.halves > 0) on_level(coordinates, reading.halves);
  SampledTile sampled;
  const Targets targets = targets_in(sampled);
  for (std::size_t n = 0; n < plane_count_; ++n) {
    const std::uint8_t background = black(planes_[n].sampling(), format_, colour_space_);
    planes_[n].sample(coordinates, reading, background, targets[n]);
  }
  write_tile(sampled, format_, colour_space_, out, area);
  if (format_ != out.format) clear_undefined(coordinates, out, area);
}

}  // namespace orbwatch::remap
