// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/coordinate_grid.h"

#include <algorithm>

#include "proc/remap/compiler/grid_compiler.h"

namespace orbwatch::remap {
namespace {

/// The area around a map that stays between `low` and `high`. Bilinear interpolation reads one
/// pixel further, for packed YUV the next two pairs; means of several places are up to a quarter of
/// a step further, which on mip level n is below 2^n pixels.
SourceArea area_around(const Coordinate& low, const Coordinate& high, int level) {
  const int margin = 4 + (1 << level);
  const auto pixel = [](std::int32_t q13) { return q13 >> kFractionBits; };
  return {pixel(low.u) - margin, pixel(low.v) - margin, pixel(high.u) + margin + 1,
          pixel(high.v) + margin + 1};
}

SourceArea area_around(const Patch& patch, int level) {
  const auto [low, high] = patch.range();
  return area_around(low, high, level);
}

SourceArea area_around(const CoordinateTile& pixels, int level) {
  SourceArea area;
  for (const CoordinateRow& row : pixels) {
    for (const Coordinate& place : row) {
      if (is_defined(place)) area = united(area, area_around(place, place, level));
    }
  }
  return area;
}

}  // namespace

CoordinateGrid::CoordinateGrid(const optics::ViewProjection& view,
                               const optics::BallProjection& ball, int source_width,
                               int source_height)
    : width_(view.width()),
      height_(view.height()),
      source_width_(source_width),
      source_height_(source_height),
      tiles_x_((width_ + kTile - 1) / kTile),
      tiles_y_((height_ + kTile - 1) / kTile),
      tiles_(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_)) {
  Compiler(*this, view, ball).run();
}

Stencil CoordinateGrid::stencil(int tx, int ty) const {
  Stencil stencil;
  for (int j = -1; j <= 2; ++j) std::copy_n(&node(tx - 1, ty + j), 4, &stencil.at(-1, j));
  return stencil;
}

FineTile<8> CoordinateGrid::curved(const Tile& tile) const {
  const int number = static_cast<int>(tile.index);
  return curved_tile(stencil(number % tiles_x_, number / tiles_x_));
}

CoordinateRow CoordinateGrid::row(int tx, int ty, int y) const {
  const Tile t = tile(tx, ty);
  CoordinateRow row;
  switch (t.kind) {
    case TileKind::Blind:
      row.fill({kBlind, 0});
      break;
    case TileKind::Outside:
      row.fill({kOutside, 0});
      break;
    case TileKind::Patch:
    case TileKind::OwnPatch:
      Patch(nodes(t, tx, ty)).row(y).write(kTile, row.data());
      break;
    case TileKind::Curved:
    case TileKind::Fine:
    case TileKind::CurvedFine:
      visit_cells(t, [&](const auto& cells) { row = cells.row(y); });
      break;
    case TileKind::Split:
      return split_[t.index].row(y);
    case TileKind::Pixels:
      return pixel_tiles_.row(t.index, y);
  }
  return row;
}

CoordinateTile CoordinateGrid::pixels(int tx, int ty) const {
  const Tile t = tile(tx, ty);
  if (t.kind == TileKind::Pixels) return pixel_tiles_.pixels(t.index);
  if (t.kind == TileKind::Split) return split_[t.index].pixels();
  CoordinateTile pixels;
  const auto write = [&pixels](const auto& cells) { pixels = cells.pixels(); };
  if (visit_cells(t, write)) return pixels;
  for (int y = 0; y < kTile; ++y) pixels[y] = row(tx, ty, y);
  return pixels;
}

SourceArea CoordinateGrid::sampled_area() const {
  SourceArea area;
  for (int ty = 0; ty < tiles_y_; ++ty) {
    for (int tx = 0; tx < tiles_x_; ++tx) area = united(area, sampled_area(tx, ty));
  }
  return common(area, {0, 0, source_width_, source_height_});
}

SourceArea CoordinateGrid::sampled_area(int tx, int ty) const {
  const Tile t = tile(tx, ty);
  if (is_empty(t.kind)) return {};
  if (is_patch(t.kind)) return area_around(Patch(nodes(t, tx, ty)), t.level);
  return area_around(pixels(tx, ty), t.level);
}

void CoordinateGrid::write_validity(const ImageView<std::uint8_t>& out) const {
  for (int ty = 0; ty < tiles_y_; ++ty) {
    for (int tx = 0; tx < tiles_x_; ++tx) write_validity(tx, ty, out);
  }
}

void CoordinateGrid::write_validity(int tx, int ty, const ImageView<std::uint8_t>& out) const {
  const int columns = std::min(kTile, width_ - tx * kTile);
  const int rows = std::min(kTile, height_ - ty * kTile);
  const auto fill = [&](Validity validity) {
    for (int y = 0; y < rows; ++y) {
      std::fill_n(out.at(tx * kTile, ty * kTile + y), columns, static_cast<std::uint8_t>(validity));
    }
  };
  const Tile t = tile(tx, ty);
  if (t.kind == TileKind::Blind) return fill(Validity::Blind);
  if (t.kind == TileKind::Outside) return fill(Validity::Outside);
  fill(Validity::Seen);
  if (is_defined_throughout(t.kind)) return;
  const CoordinateTile coordinates = pixels(tx, ty);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Coordinate& c = coordinates[y][x];
      if (is_defined(c)) continue;
      const Validity validity = c.u == kBlind ? Validity::Blind : Validity::Outside;
      *out.at(tx * kTile + x, ty * kTile + y) = static_cast<std::uint8_t>(validity);
    }
  }
}

std::size_t CoordinateGrid::bytes() const {
  const auto bytes = [](const auto&... parts) {
    return (... + (parts.size() * sizeof(parts.front())));
  };
  return tiles_.bytes() + pixel_tiles_.bytes() + bytes(nodes_, own_nodes_, split_, fine_);
}

}  // namespace orbwatch::remap
