#include "proc/remap/tile_remap.h"

#include <algorithm>
#include <cassert>

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

TargetPlane plane_of_view(const MutablePicture& out, const PlaneSampling& sampling,
                          const TileArea& area) {
  const auto& plane = out.planes[sampling.plane];
  const int x = area.x >> shift(sampling.x), y = area.y >> shift(sampling.y);
  auto* const data = reinterpret_cast<std::uint8_t*>(plane.data) + y * plane.stride +
                     std::ptrdiff_t{x} * info(sampling.layout).out_bytes();
  return {data, plane.stride, kTile >> shift(sampling.x), kTile >> shift(sampling.y)};
}

SourcePlane plane_of_source(const Picture& picture, const PlaneSampling& sampling) {
  const auto& plane = picture.planes[sampling.plane];
  return {reinterpret_cast<const std::uint8_t*>(plane.data) + sampling.offset, plane.stride,
          picture.width >> shift(sampling.x), picture.height >> shift(sampling.y)};
}

TargetPlane plane_of(SampledTile& sampled, std::size_t n, const PlaneSampling& sampling) {
  return {sampled.planes[n].data(), SampledTile::stride(sampling), kTile >> shift(sampling.x),
          kTile >> shift(sampling.y)};
}

/// The planes lie in the view as they were sampled.
bool is_written_in_place(PixelFormat format, const MutablePicture& out, const TileArea& area) {
  return format == out.format && format != PixelFormat::Yuyv && format != PixelFormat::Uyvy &&
         area.columns == kTile && area.rows == kTile;
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
      halves_(static_cast<int>(std::min<std::size_t>(source.size(), kMaxLevel)) - 1),
      format_(source.front().format),
      colour_space_(source.front().colour_space),
      interpolation_(interpolation),
      kernel_(kernel),
      samplings_(samplings(format_)) {
  assert(source.front().width == grid.source_width());
  assert(source.front().height == grid.source_height());
  for (std::size_t level = 0; level < std::min(source.size(), sources_.size()); ++level) {
    for (std::size_t n = 0; n < samplings_.count; ++n) {
      sources_[level][n] = plane_of_source(source[level], samplings_.items[n]);
    }
  }
}

void TileRemap::write(int tx, int ty, const MutablePicture& out, const TileArea& area) const {
  const Tile tile = grid_.tile(tx, ty);
  if (tile.kind == TileClass::Blind || tile.kind == TileClass::Outside) {
    return clear_area(out, area);
  }
  const Minification small = minification(tile.level);
  const bool smooth =
      tile.kind == TileClass::Patch && tile.interior && interpolation_ != Interpolation::Nearest;
  if (smooth) {
    const Patch patch = grid_.patch(tx, ty);
    if (small.halves == 0 ? write_patch(patch, small, out, area)
                          : write_patch(on_level(patch, small.halves), small, out, area)) {
      return;
    }
  }
  write_dense(tx, ty, small, out, area);
}

/// The last factor of two is left to samples, which keeps more detail than a half of the picture.
TileRemap::Minification TileRemap::minification(int level) const {
  if (level == 0 || interpolation_ != Interpolation::Area) return {};
  return {std::min(level - 1, halves_), true};
}

/// False if some sampling's blocks do not fit a kernel.
bool TileRemap::write_patch(const Patch& patch, const Minification& small,
                            const MutablePicture& out, const TileArea& area) const {
  const bool in_place = is_written_in_place(format_, out, area);
  SampledTile sampled;
  for (std::size_t n = 0; n < samplings_.count; ++n) {
    const PlaneSampling& sampling = samplings_.items[n];
    const TargetPlane target =
        in_place ? plane_of_view(out, sampling, area) : plane_of(sampled, n, sampling);
    const bool subsampled = sampling.x != Siting::Full || sampling.y != Siting::Full;
    const bool fits = has_kernel(sampling.layout) &&
                      (subsampled ? fill(on_plane(patch, sampling), small, n, target)
                                  : fill(patch, small, n, target));
    if (!fits) return false;
  }
  if (!in_place) write_tile(sampled, format_, colour_space_, out, area);
  return true;
}

bool TileRemap::fill(const Patch& patch, const Minification& small, std::size_t sampling,
                     const TargetPlane& target) const {
  const Layout layout = samplings_.items[sampling].layout;
  const SourcePlane& source = sources_[small.halves][sampling];
  return small.oversampled ? sample_oversampled(patch, layout, source, target)
                           : sample(patch, layout, source, target);
}

// Inlined, its large tile would cost every tile of a view 19 instructions.
[[gnu::noinline]] bool TileRemap::sample_oversampled(const Patch& patch, Layout layout,
                                                     const SourcePlane& source,
                                                     const TargetPlane& target) const {
  const Patch fine = at_half_steps(patch);
  return oversample(layout, target, [&](int left, int top, const TargetPlane& quarter) {
    return sample(moved(fine, left, top), layout, source, quarter);
  });
}

bool TileRemap::sample(const Patch& patch, Layout layout, const SourcePlane& source,
                       const TargetPlane& target) const {
  return sample_blocks(patch, layout, source, target) ||
         sample_steep(patch, layout, source, target);
}

bool TileRemap::sample_blocks(const Patch& patch, Layout layout, const SourcePlane& source,
                              const TargetPlane& target) const {
  const auto map = BlockMap::make(patch, target.columns / kBlock, target.rows / kBlock,
                                  added_u(layout), added_v(layout));
  if (!map) return false;
  kernel_.tile(layout, {*map, source.data, source.stride, target.data, target.stride});
  return true;
}

/// Blocks that do not fit their windows may do so at half the step: every second row of those.
bool TileRemap::sample_steep(const Patch& patch, Layout layout, const SourcePlane& source,
                             const TargetPlane& target) const {
  const Patch fine = at_half_rows(patch);
  const std::ptrdiff_t stride = std::ptrdiff_t{kTile} * info(layout).out_bytes();
  alignas(64) std::array<std::uint8_t, kTile * kTile * 4> rows;
  for (int top = 0; top < 2 * target.rows; top += kTile) {
    const TargetPlane part{rows.data(), stride, target.columns, kTile};
    if (!sample_blocks(moved(fine, 0, top), layout, source, part)) return false;
    for (int y = 0; y < kTile; y += 2) {
      std::copy_n(&rows[y * stride], target.columns * info(layout).out_bytes(),
                  target.data + (top + y) / 2 * target.stride);
    }
  }
  return true;
}

void TileRemap::write_dense(int tx, int ty, const Minification& small, const MutablePicture& out,
                            const TileArea& area) const {
  CoordinateTile coordinates = grid_.pixels(tx, ty), shared;
  if (interpolation_ == Interpolation::Nearest) round_to_pixels(coordinates);
  if (small.halves > 0) on_level(coordinates, small.halves);
  SampledTile sampled;
  for (std::size_t n = 0; n < samplings_.count; ++n) {
    const PlaneSampling& sampling = samplings_.items[n];
    on_plane(coordinates, sampling, shared);
    const SourcePlane& source = sources_[small.halves][n];
    const std::uint8_t background = black(sampling, format_, colour_space_);
    const TargetPlane target = plane_of(sampled, n, sampling);
    small.oversampled ? oversample_dense(shared, sampling.layout, source, background, target)
                      : sample_dense(shared, sampling.layout, source, background, target);
  }
  write_tile(sampled, format_, colour_space_, out, area);
  if (format_ != out.format) clear_undefined(coordinates, out, area);
}

}  // namespace orbwatch::remap
