// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/plane_sampler.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/sampling/downsampling.h"
#include "proc/remap/sampling/half_steps.h"
#include "proc/remap/sampling/sharpened_picture.h"

namespace orbwatch::remap {
namespace {

/// Planes that are one pixel wide or high are sampled by the scalar kernel only.
void sample_job(const Kernel& kernel, Layout layout, const PointJob& job) {
  const bool has_neighbours = job.source.width > 1 && job.source.height > 1;
  (has_neighbours ? kernel : scalar_kernel()).sample_points(layout, job);
}

void make_black(const CoordinateTile& coordinates, std::uint8_t black, int pixel_bytes,
                const TargetPlane& target) {
  for (int y = 0; y < target.rows; ++y) {
    const CoordinateRow& places = coordinates[y];
    bool all_defined = true;
    for (int x = 0; x < target.columns; ++x) all_defined &= is_defined(places[x]);
    if (all_defined) continue;
    std::uint8_t* const row = target.data + y * target.stride;
    for (int x = 0; x < target.columns; ++x) {
      if (!is_defined(places[x])) std::fill_n(row + x * pixel_bytes, pixel_bytes, black);
    }
  }
}

constexpr std::size_t number(Layout layout) { return static_cast<std::size_t>(layout); }

SourcePlane plane_of_source(const Picture& picture, const PlaneSampling& sampling) {
  const auto& plane = picture.planes[sampling.plane];
  return {reinterpret_cast<const std::uint8_t*>(plane.data) + sampling.offset, plane.stride,
          picture.width >> shift(sampling.x), picture.height >> shift(sampling.y)};
}

/// Buffer for samples at half steps along one axis, most of which are discarded.
struct FineSamples {
  alignas(64) std::array<std::uint8_t, 2 * kTile * kTile * 4> bytes;

  TargetPlane plane(int pixel_bytes, int columns, int rows) {
    return {bytes.data(), std::ptrdiff_t{kTile} * pixel_bytes, columns, rows};
  }
};

/// Prefetches the place to the right of a target of that width. Samples at half steps are read back
/// as soon as they are written, behind all earlier stores: these must not wait for memory.
void prefetch_beside(const TargetPlane& target, int row_bytes) {
  const std::uint8_t* row = target.data + row_bytes;
  for (int y = 0; y < target.rows; ++y, row += target.stride) {
    __builtin_prefetch(row, 1);
    __builtin_prefetch(row + row_bytes - 1, 1);
  }
}

/// True for planes that SharpenedPicture replaces.
bool may_be_sharpened(const PlaneSampling& sampling, PixelFormat format) {
  return can_sharpen(format) && sampling.x == Siting::Full;
}

/// A step's square in Q40.
constexpr std::int64_t square_of_step(double step) {
  return static_cast<std::int64_t>(step * step * (1 << 20)) << 20;
}

}  // namespace

void sample_points(const Kernel& kernel, Layout layout, const Patch& patch,
                   const SourcePlane& source, const TargetPlane& target) {
  Places places;
  kernel.locate(PointMap(patch), target.columns, target.rows, places);
  sample_job(kernel, layout, {places, source, target});
}

void sample_points(const Kernel& kernel, Layout layout, const CoordinateTile& coordinates,
                   std::uint8_t black, const SourcePlane& source, const TargetPlane& target) {
  assert(target.columns * target.rows % kPointRun == 0);
  Places places;
  for (int y = 0; y < target.rows; ++y) {
    std::int32_t *const u = places.u + y * target.columns, *const v = places.v + y * target.columns;
    for (int x = 0; x < target.columns; ++x) {
      u[x] = coordinates[y][x].u;
      v[x] = coordinates[y][x].v;
    }
  }
  sample_job(kernel, layout, {places, source, target});
  make_black(coordinates, black, info(layout).out_bytes(), target);
}

PlaneSampler::PlaneSampler(const PlaneSampling& sampling, std::span<const Picture> pictures,
                           const Kernel& kernel)
    : sampling_(sampling),
      kernel_(&kernel),
      rounding_(BlockMap::rounding(added_u(sampling.layout), added_v(sampling.layout))),
      columns_(kTile >> shift(sampling.x)),
      rows_(kTile >> shift(sampling.y)),
      pixel_bytes_(info(sampling.layout).out_bytes()),
      tile_bytes_(columns_ * pixel_bytes_),
      longest_step2_(square_of_step(may_be_sharpened(sampling, pictures.front().format)
                                        ? kLongestSharpenedStep
                                        : kLongestStep)) {
  if (number(sampling.layout) < kKernelLayouts) {
    block_kernel_ = kernel.tiles[number(sampling.layout)];
    even_columns_ = kernel.even_columns[number(sampling.layout)];
    even_rows_ = kernel.even_rows[number(sampling.layout)];
    means_along_x_ = kernel.means_along_x[number(sampling.layout)];
    means_along_y_ = kernel.means_along_y[number(sampling.layout)];
    means_of_four_ = kernel.means_of_four[number(sampling.layout)];
  }
  for (std::size_t level = 0; level < std::min(pictures.size(), sources_.size()); ++level) {
    sources_[level] = plane_of_source(pictures[level], sampling);
  }
}

void PlaneSampler::fetch(const SourceArea& area) const {
  const SourcePlane& source = sources_[0];
  const int bytes = info(sampling_.layout).pixel_bytes;
  const std::ptrdiff_t first = (area.left >> shift(sampling_.x)) * bytes;
  const std::ptrdiff_t last = (((area.right - 1) >> shift(sampling_.x)) + 1) * bytes - 1;
  for (int y = area.top >> shift(sampling_.y); y <= (area.bottom - 1) >> shift(sampling_.y); ++y) {
    const std::uint8_t* const row = source.data + y * source.stride;
    for (std::ptrdiff_t at = first; at < last; at += kCacheLine) __builtin_prefetch(row + at);
    __builtin_prefetch(row + last);
  }
}

void PlaneSampler::sample(const CoordinateTile& coordinates, Reading reading, std::uint8_t black,
                          const TargetPlane& target) const {
  CoordinateTile shared;
  const bool full = sampling_.x == Siting::Full;
  if (!full) on_plane(coordinates, sampling_, shared);
  const CoordinateTile& places = full ? coordinates : shared;
  if (!reading.averaged) {
    return sample_points(*kernel_, sampling_.layout, places, black, sources_[0], target);
  }
  const HalfSteps steps(places, target.columns, target.rows);
  OversampledTile tile;
  const int columns = 2 * target.columns, rows = 2 * target.rows;
  const std::ptrdiff_t stride = OversampledTile::stride(sampling_.layout);
  for (int top = 0; top < rows; top += kTile) {
    for (int left = 0; left < columns; left += kTile) {
      Places quarter;
      steps.locate(left, top, quarter);
      std::uint8_t* const part = tile.samples.data() + top * stride + left * pixel_bytes_;
      sample_job(*kernel_, sampling_.layout,
                 {quarter, sources_[reading.mip_level], {part, stride, kTile, kTile}});
    }
  }
  average(tile, sampling_.layout, {true, true}, target);
  make_black(places, black, pixel_bytes_, target);
}

void PlaneSampler::sample(const Patch& patch, Reading reading, const TargetPlane& target) const {
  const Patch map = on_plane(patch, sampling_);
  const SourcePlane& source = sources_[reading.mip_level];
  if (!reading.averaged) return sample_once(map, reading.in_windows, source, target);
  const TwiceAlong twice = twice_along(map, target);
  const bool in_blocks = reading.in_windows && has_blocks();
  if (!twice.x && !twice.y) {
    if (!in_blocks) return sample_once(map, false, source, target);
    if (sample_blocks(map, source, target)) return;
  } else if (sample_means(map, twice, reading, target)) {
    return;
  }
  // At half steps along both axes, most blocks fit their windows.
  sample_means(map, {true, true}, reading, target);
}

/// Fills a target with means of two or four samples. False, and then undefined: along one axis
/// alone, they do not fit windows.
bool PlaneSampler::sample_means(const Patch& patch, TwiceAlong twice, const Reading& reading,
                                const TargetPlane& target) const {
  const Patch fine = !twice.y   ? at_half_steps_along_x(patch)
                     : !twice.x ? at_half_steps_along_y(patch)
                                : at_half_steps(patch);
  const int shift_x = twice.x ? 1 : 0;
  TargetPlane part = target;
  part.columns = std::min(target.columns, kTile >> shift_x);
  if (!sample_column_of_means(fine, twice, reading, part)) return false;
  if (part.columns == target.columns) return true;
  part.data += part.columns * pixel_bytes_;
  return sample_column_of_means(moved(fine, kTile, 0), twice, reading, part);
}

/// The axes along which a target's pixels are means of two samples.
TwiceAlong PlaneSampler::twice_along(const Patch& patch, const TargetPlane& target) const {
  // Less than a block would be sampled pixel by pixel.
  if (target.columns < kBlock || target.rows < kBlock) return {true, true};
  const UvXy32 slope = slope_at(patch, target.columns / 2, target.rows / 2);
  static_assert(kFractionBits + UvQuadratic::kSlopeBits == 20, "squares are Q40");
  const auto is_long = [&](int u, int v) {
    return std::int64_t{slope[u]} * slope[u] + std::int64_t{slope[v]} * slope[v] > longest_step2_;
  };
  return {is_long(0, 1), is_long(2, 3)};
}

/// Samples each pixel of a target once.
void PlaneSampler::sample_once(const Patch& patch, bool in_windows, const SourcePlane& source,
                               const TargetPlane& target) const {
  if (!in_windows || !has_blocks() || target.columns < kBlock || target.rows < kBlock) {
    sample_points(*kernel_, sampling_.layout, patch, source, target);
  } else if (!sample_blocks(patch, source, target)) {
    sample_steep(patch, source, target);
  }
}

/// The same for samples of `fine` that are at most kTile wide.
bool PlaneSampler::sample_column_of_means(const Patch& fine, TwiceAlong twice,
                                          const Reading& reading, const TargetPlane& target) const {
  const bool in_blocks = reading.in_windows && has_blocks();
  if (in_blocks && average_blocks(fine, twice, reading, target)) return true;
  TargetPlane part = target;
  part.rows = std::min(target.rows, kTile >> (twice.y ? 1 : 0));
  for (int y = 0; y < target.rows; y += part.rows, part.data += part.rows * part.stride) {
    const Patch from_here = y == 0 ? fine : moved(fine, 0, kTile);
    const bool is_new = part.rows < target.rows;
    if (is_new && in_blocks && average_blocks(from_here, twice, reading, part)) continue;
    if (in_blocks && !(twice.x && twice.y)) return false;
    OversampledTile tile;
    sample_once(from_here, reading.in_windows, sources_[reading.mip_level],
                samples_of(part, twice, tile));
    average(tile, sampling_.layout, twice, part);
  }
  return true;
}

/// The same in blocks. False: they do not fit windows.
[[gnu::always_inline]] inline bool PlaneSampler::average_blocks(const Patch& fine, TwiceAlong twice,
                                                                const Reading& reading,
                                                                const TargetPlane& target) const {
  const SourcePlane& source = sources_[reading.mip_level];
  OversampledTile tile;
  const TargetPlane samples = samples_of(target, twice, tile);
  BlockMap map;
  if (!map.fit(fine, samples.columns, samples.rows, rounding_)) return false;
  const Kernel::Tile means = !twice.y ? means_along_x_ : !twice.x ? means_along_y_ : means_of_four_;
  if (means != nullptr && samples.columns == kTile) {
    means({map, source, target});
  } else {
    block_kernel_({map, source, samples});
    average(tile, sampling_.layout, twice, target);
  }
  return true;
}

/// Place in `tile` of the samples whose means fill a target.
TargetPlane PlaneSampler::samples_of(const TargetPlane& target, TwiceAlong twice,
                                     OversampledTile& tile) const {
  return {tile.samples.data(), OversampledTile::stride(sampling_.layout),
          target.columns << (twice.x ? 1 : 0), target.rows << (twice.y ? 1 : 0)};
}

/// Samples blocks that do not fit their windows but may do so at half the step, along one axis or
/// both; not worth it for a single block in a row.
void PlaneSampler::sample_steep(const Patch& patch, const SourcePlane& source,
                                const TargetPlane& target) const {
  if (target.columns >= 2 * kBlock) {
    prefetch_beside(target, tile_bytes_);
    if (sample_half_rows(patch, source, target)) return;
    if (sample_half_columns(patch, source, target)) return;
  }
  sample_points(*kernel_, sampling_.layout, patch, source, target);
}

/// Samples with a kernel that keeps half of the pixels of a `fine` target. False: they do not fit
/// windows.
bool PlaneSampler::keep_half(Kernel::Tile kernel, const Patch& patch, const SourcePlane& source,
                             const TargetPlane& fine, const TargetPlane& kept) const {
  BlockMap map;
  if (!map.fit(patch, fine.columns, fine.rows, rounding_)) return false;
  kernel({map, source, kept});
  return true;
}

bool PlaneSampler::sample_half_rows(const Patch& patch, const SourcePlane& source,
                                    const TargetPlane& target) const {
  const Patch half = at_half_rows(patch);
  FineSamples samples;
  const TargetPlane fine = samples.plane(pixel_bytes_, target.columns, 2 * target.rows);
  if (even_rows_ != nullptr) return keep_half(even_rows_, half, source, fine, target);
  if (!sample_blocks(half, source, fine)) return false;
  keep_even_rows(fine, target.columns * pixel_bytes_, target);
  return true;
}

/// A subsampled plane may be steep along x only. A patch that is steep along both axes needs both.
bool PlaneSampler::sample_half_columns(const Patch& patch, const SourcePlane& source,
                                       const TargetPlane& target) const {
  const Patch half = at_half_columns(patch);
  FineSamples samples;
  for (int left = 0; left < 2 * target.columns; left += kTile) {
    const Patch from_left = left == 0 ? half : moved(half, left, 0);
    const TargetPlane fine = samples.plane(pixel_bytes_, kTile, target.rows);
    const TargetPlane kept{target.data + left / 2 * pixel_bytes_, target.stride, kTile / 2,
                           target.rows};
    const bool is_kept = even_columns_ != nullptr;
    if (is_kept && keep_half(even_columns_, from_left, source, fine, kept)) continue;
    const bool fits = !is_kept && sample_blocks(from_left, source, fine);
    if (!fits && !sample_half_rows(from_left, source, fine)) return false;
    keep_even_columns(fine, pixel_bytes_, kept);
  }
  return true;
}

}  // namespace orbwatch::remap
