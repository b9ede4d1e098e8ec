#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/image/validity.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::remap {

/// Views are cut into tiles of 16x16 pixels; the grid has a node at each tile's corner.
inline constexpr int kTile = 16;
/// Source coordinates are fixed point with this many fraction bits (Q13).
inline constexpr int kFractionBits = 13;
/// Largest distance in source pixels between a tile's patch and the exact map.
inline constexpr double kPatchTolerance = 1.0 / 64;

/// A place in the source picture, Q13 pixels. In a dense tile u may be a marker instead.
struct Coordinate {
  std::int32_t u = 0;
  std::int32_t v = 0;
};
inline constexpr std::int32_t kBlind = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int32_t kOutside = kBlind + 1;
constexpr bool is_defined(const Coordinate& c) { return c.u > kOutside; }

/// How a tile's coordinates are kept.
enum class TileClass : std::uint8_t {
  Blind,    ///< no pixel is on the ball's picture: filled without reading
  Outside,  ///< every pixel falls outside the source picture: filled without reading
  Patch,    ///< bilinear between the four nodes plus second differences
  Dense,    ///< one coordinate or marker per pixel
};

struct Tile {
  TileClass kind = TileClass::Blind;
  bool interior = false;    ///< every pixel and its right and lower neighbour lie in the source
  std::uint32_t dense = 0;  ///< Dense: index of the tile's first coordinate
};

/// One row of a patch: source coordinates by forward differences, exact in integers, so that every
/// kernel on every architecture steps through the same values.
struct PatchRow {
  static constexpr int kScaleBits = 11;  ///< values are Q(13 + 11)
  std::int64_t u, du, ddu;
  std::int64_t v, dv, ddv;

  Coordinate current() const {
    constexpr std::int64_t kHalf = std::int64_t{1} << (kScaleBits - 1);
    return {static_cast<std::int32_t>((u + kHalf) >> kScaleBits),
            static_cast<std::int32_t>((v + kHalf) >> kScaleBits)};
  }
  void step() {
    u += du;
    du += ddu;
    v += dv;
    dv += ddv;
  }
};

/// The map from a view's pixels to one source's pixels, compiled so that the frame path needs
/// neither trigonometry nor a map of full size. Immutable; reentrant.
class CoordinateGrid {
 public:
  /// Evaluates the exact map at the nodes and checks each tile's patch against it; tiles that are
  /// off by more than kPatchTolerance go dense. Allocates; not for the frame path.
  CoordinateGrid(const optics::ViewProjection& view, const optics::BallProjection& ball,
                 int source_width, int source_height);

  int width() const { return width_; }
  int height() const { return height_; }
  int source_width() const { return source_width_; }
  int source_height() const { return source_height_; }
  int tiles_x() const { return tiles_x_; }
  int tiles_y() const { return tiles_y_; }

  const Tile& tile(int tx, int ty) const {
    return tiles_[static_cast<std::size_t>(ty) * tiles_x_ + tx];
  }
  /// Row `y`, 0..15, of a Patch tile, at the tile's first pixel.
  PatchRow patch_row(int tx, int ty, int y) const;
  /// Row `y`, 0..15, of a Dense tile: kTile coordinates.
  const Coordinate* dense_row(const Tile& tile, int y) const {
    return dense_.data() + tile.dense + static_cast<std::ptrdiff_t>(y) * kTile;
  }

  /// One Validity per pixel into `out`, which has the view's size.
  void write_validity(const ImageView<std::uint8_t>& out) const;

  /// Memory of the map in bytes.
  std::size_t bytes() const;

 private:
  struct Exact;

  const Coordinate& node(int i, int j) const {
    return nodes_[static_cast<std::size_t>(j + 1) * (tiles_x_ + 3) + (i + 1)];
  }
  Tile classify(const Exact& exact, int tx, int ty);
  bool patch_is_possible(int tx, int ty) const;
  bool patch_is_close(const Exact& exact, int tx, int ty) const;
  Tile patch_tile(int tx, int ty) const;
  Tile dense_tile(const Exact& exact, int tx, int ty);

  int width_;
  int height_;
  int source_width_;
  int source_height_;
  int tiles_x_;
  int tiles_y_;
  std::vector<Coordinate> nodes_;  ///< (tiles + 1) corners and a ring of one around them
  std::vector<Tile> tiles_;
  std::vector<Coordinate> dense_;
};

}  // namespace orbwatch::remap
