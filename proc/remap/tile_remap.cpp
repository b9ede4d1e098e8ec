#include "proc/remap/tile_remap.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "proc/remap/oversampling.h"
#include "proc/remap/plane_map.h"

namespace orbwatch::remap {
namespace {

using DenseSampling = void (*)(const CoordinateTile&, const SourcePlane&, std::uint8_t,
                               const TargetPlane&);
constexpr std::array<DenseSampling, kLayouts> kDenseSampling{
    sample_dense<Layout::One8>,        sample_dense<Layout::Two8>,
    sample_dense<Layout::Three8>,      sample_dense<Layout::Four8>,
    sample_dense<Layout::FirstOfTwo8>, sample_dense<Layout::OddOfFour8>,
    sample_dense<Layout::One16>,       sample_dense<Layout::Three16>};

constexpr bool has_kernel(Layout layout) {
  return static_cast<std::size_t>(layout) < kKernelLayouts;
}

void sample_dense(const CoordinateTile& coordinates, Layout layout, const SourcePlane& source,
                  std::uint8_t black, const TargetPlane& out) {
  kDenseSampling[static_cast<std::size_t>(layout)](coordinates, source, black, out);
}

constexpr int in_blocks(int pixels) {
  return static_cast<int>(static_cast<unsigned>(pixels) / kBlock);
}

/// Where a quarter of an oversampled tile lies, from its pixel (left, top) on.
TargetPlane quarter_of(OversampledTile& tile, Layout layout, const TargetPlane& whole, int left,
                       int top) {
  const std::ptrdiff_t stride = OversampledTile::stride(layout);
  return {tile.samples.data() + top * stride + left * info(layout).out_bytes(), stride,
          std::min(kTile, 2 * whole.columns - left), std::min(kTile, 2 * whole.rows - top)};
}

/// Fills a target with means of four, if `sample(left, top, plane)` can sample every quarter of the
/// oversampled tile, that from its pixel (left, top) on, into its plane.
template <class Sample>
bool oversample(Layout layout, const TargetPlane& target, const Sample& sample) {
  OversampledTile tile;
  for (int top = 0; top < 2 * target.rows; top += kTile) {
    for (int left = 0; left < 2 * target.columns; left += kTile) {
      if (!sample(left, top, quarter_of(tile, layout, target, left, top))) return false;
    }
  }
  average(tile, layout, target);
  return true;
}

void oversample_dense(const CoordinateTile& coordinates, Layout layout, const SourcePlane& source,
                      std::uint8_t black, const TargetPlane& target) {
  CoordinateTile quarter;
  oversample(layout, target, [&](int left, int top, const TargetPlane& plane) {
    at_half_steps(coordinates, target.columns, target.rows, left, top, quarter);
    sample_dense(quarter, layout, source, black, plane);
    return true;
  });
}

/// Every second of a tile's rows, of a multiple of eight bytes.
void copy_every_second(const std::uint8_t* rows, std::ptrdiff_t stride, int bytes, std::uint8_t* to,
                       std::ptrdiff_t to_stride) {
  constexpr int kUnit = 8;  // a constant, for std::memcpy to be no call
  for (int y = 0; y < kTile; y += 2, rows += 2 * stride, to += to_stride) {
    for (int x = 0; x < bytes; x += kUnit) std::memcpy(to + x, rows + x, kUnit);
  }
}

SourcePlane plane_of_source(const Picture& picture, const PlaneSampling& sampling) {
  const auto& plane = picture.planes[sampling.plane];
  return {reinterpret_cast<const std::uint8_t*>(plane.data) + sampling.offset, plane.stride,
          picture.width >> shift(sampling.x), picture.height >> shift(sampling.y)};
}

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
    Plane& plane = planes_[n];
    plane.sampling = samplings(format_).items[n];
    const Layout layout = plane.sampling.layout;
    if (has_kernel(layout)) plane.kernel = kernel.tiles[static_cast<std::size_t>(layout)];
    plane.rounding = BlockMap::rounding(added_u(layout), added_v(layout));
    plane.columns = kTile >> shift(plane.sampling.x);
    plane.rows = kTile >> shift(plane.sampling.y);
    plane.out_bytes = info(layout).out_bytes();
    for (int level = 0; level <= most_halves_; ++level) {
      plane.sources[level] = plane_of_source(source[level], plane.sampling);
    }
  }
}

/// The last factor of two is left to samples, which keeps more detail than a half of the picture.
TileRemap::Halves TileRemap::halves(int level) const {
  if (level == 0 || interpolation_ != Interpolation::Area) return kPlain;
  return std::min(level - 1, most_halves_);
}

TargetPlane TileRemap::plane_of_view(const MutablePicture& out, const Plane& plane,
                                     const TileArea& area) {
  const auto& to = out.planes[plane.sampling.plane];
  const int x = area.x >> shift(plane.sampling.x), y = area.y >> shift(plane.sampling.y);
  auto* const data = reinterpret_cast<std::uint8_t*>(to.data) + y * to.stride +
                     std::ptrdiff_t{x} * plane.out_bytes;
  return {data, to.stride, plane.columns, plane.rows};
}

TargetPlane TileRemap::plane_of(SampledTile& sampled, std::size_t n, const Plane& plane) {
  return {sampled.planes[n].data(), SampledTile::stride(plane.sampling), plane.columns, plane.rows};
}

// What most tiles go through is inlined into one function, and what few need is not: it would cost
// all of them registers.

/// Fills the target_of(plane, n) of each sampling; false if some sampling's blocks do not fit a
/// kernel.
template <class TargetOf>
[[gnu::always_inline]] inline bool TileRemap::sample_planes(const Patch& patch, Halves halves,
                                                            const TargetOf& target_of) const {
  for (std::size_t n = 0; n < plane_count_; ++n) {
    const Plane& plane = planes_[n];
    if (plane.kernel == nullptr) return false;
    const auto fill = [&](const Patch& map) __attribute__((always_inline)) {
      return (halves == kPlain &&
              sample_blocks(map, plane, plane.sources[0], target_of(plane, n))) ||
             sample_finely(map, plane, halves, target_of(plane, n));
    };
    const bool fits =
        plane.sampling.x == Siting::Full ? fill(patch) : fill(on_plane(patch, plane.sampling));
    if (!fits) return false;
  }
  return true;
}

[[gnu::noinline]] bool TileRemap::write_converted(const Patch& patch, Halves halves,
                                                  const MutablePicture& out,
                                                  const TileArea& area) const {
  SampledTile sampled;
  const bool fits = sample_planes(patch, halves, [&](const Plane& plane, std::size_t n) {
    return plane_of(sampled, n, plane);
  });
  if (fits) write_tile(sampled, format_, colour_space_, out, area);
  return fits;
}

[[gnu::always_inline]] inline bool TileRemap::sample_blocks(const Patch& patch, const Plane& plane,
                                                            const SourcePlane& source,
                                                            const TargetPlane& target) {
  BlockMap map;
  if (!map.fit(patch, in_blocks(target.columns), in_blocks(target.rows), plane.rounding))
    return false;
  plane.kernel({map, source.data, source.stride, target.data, target.stride});
  return true;
}

[[gnu::noinline]] bool TileRemap::sample_finely(const Patch& patch, const Plane& plane,
                                                Halves halves, const TargetPlane& target) {
  if (halves == kPlain) return sample_steep(patch, plane, plane.sources[0], target);
  const SourcePlane& source = plane.sources[halves];
  const Patch fine = at_half_steps(patch);
  return oversample(plane.sampling.layout, target,
                    [&](int left, int top, const TargetPlane& quarter) {
                      const Patch part = moved(fine, left, top);
                      return sample_blocks(part, plane, source, quarter) ||
                             sample_steep(part, plane, source, quarter);
                    });
}

/// Blocks that do not fit their windows may do so at half the step: every second row of those.
bool TileRemap::sample_steep(const Patch& patch, const Plane& plane, const SourcePlane& source,
                             const TargetPlane& target) {
  const Patch fine = at_half_rows(patch);
  const std::ptrdiff_t stride = std::ptrdiff_t{kTile} * plane.out_bytes;
  alignas(64) std::array<std::uint8_t, kTile * kTile * 4> rows;
  for (int top = 0; top < 2 * target.rows; top += kTile) {
    const TargetPlane part{rows.data(), stride, target.columns, kTile};
    if (!sample_blocks(top == 0 ? fine : moved(fine, 0, top), plane, source, part)) return false;
    copy_every_second(rows.data(), stride, target.columns * plane.out_bytes,
                      target.data + top / 2 * target.stride, target.stride);
  }
  return true;
}

[[gnu::always_inline]] inline void TileRemap::write_tile_at(int tx, int ty, bool in_place,
                                                            const MutablePicture& out,
                                                            const TileArea& area) const {
  const Tile tile = grid_.tile(tx, ty);
  if (tile.kind == TileClass::Blind || tile.kind == TileClass::Outside) {
    return clear_area(out, area);
  }
  const Halves halves = this->halves(tile.level);
  if (tile.kind == TileClass::Patch && tile.interior && interpolation_ != Interpolation::Nearest) {
    Patch patch(grid_.nodes(tile, tx, ty));
    if (halves > 0) patch = on_level(patch, halves);
    const auto place = [&](const Plane& plane, std::size_t) {
      return plane_of_view(out, plane, area);
    };
    if (in_place && area.columns == kTile && area.rows == kTile
            ? sample_planes(patch, halves, place)
            : write_converted(patch, halves, out, area)) {
      return;
    }
  }
  write_dense(tx, ty, halves, out, area);
}

void TileRemap::write(int tx, int ty, const MutablePicture& out, const TileArea& area) const {
  write_tile_at(tx, ty, lies_as_sampled(format_, out.format), out, area);
}

void TileRemap::write_row(int ty, const MutablePicture& out) const {
  const bool in_place = lies_as_sampled(format_, out.format);
  for (int tx = 0; tx < grid_.tiles_x(); ++tx) {
    write_tile_at(tx, ty, in_place, out, area_of(grid_, tx, ty));
  }
}

void TileRemap::write_dense(int tx, int ty, Halves halves, const MutablePicture& out,
                            const TileArea& area) const {
  CoordinateTile coordinates = grid_.pixels(tx, ty), shared;
  if (interpolation_ == Interpolation::Nearest) round_to_pixels(coordinates);
  if (halves > 0) on_level(coordinates, halves);
  SampledTile sampled;
  for (std::size_t n = 0; n < plane_count_; ++n) {
    const PlaneSampling& sampling = planes_[n].sampling;
    on_plane(coordinates, sampling, shared);
    const SourcePlane& source = planes_[n].sources[std::max(halves, 0)];
    const std::uint8_t background = black(sampling, format_, colour_space_);
    const TargetPlane target = plane_of(sampled, n, planes_[n]);
    halves == kPlain ? sample_dense(shared, sampling.layout, source, background, target)
                     : oversample_dense(shared, sampling.layout, source, background, target);
  }
  write_tile(sampled, format_, colour_space_, out, area);
  if (format_ != out.format) clear_undefined(coordinates, out, area);
}

}  // namespace orbwatch::remap
