// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/plane_sampler.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/sampling/downsampling.h"
#include "proc/remap/sampling/half_steps.h"

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

/// Fills a target with means of four: `sample(left, top, plane)` is called for each part of the
/// oversampled tile that has a tile's size and begins at its pixel (left, top), with that part's
/// plane.
template <class Sample>
[[gnu::always_inline]] inline void oversample(Layout layout, const TargetPlane& target,
                                              const Sample& sample) {
  OversampledTile tile;
  const int columns = 2 * target.columns, rows = 2 * target.rows;
  const std::ptrdiff_t stride = OversampledTile::stride(layout);
  if (columns <= kTile && rows <= kTile) {
    sample(0, 0, TargetPlane{tile.samples.data(), stride, columns, rows});
    return average(tile, layout, target);
  }
  for (int top = 0; top < rows; top += kTile) {
    for (int left = 0; left < columns; left += kTile) {
      std::uint8_t* const part =
          tile.samples.data() + top * stride + left * info(layout).out_bytes();
      sample(left, top, TargetPlane{part, stride, std::min(kTile, columns - left), kTile});
    }
  }
  average(tile, layout, target);
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
      tile_bytes_(columns_ * pixel_bytes_) {
  if (number(sampling.layout) < kKernelLayouts) {
    block_kernel_ = kernel.tiles[number(sampling.layout)];
    even_columns_ = kernel.even_columns[number(sampling.layout)];
    even_rows_ = kernel.even_rows[number(sampling.layout)];
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
  oversample(sampling_.layout, target, [&](int left, int top, const TargetPlane& plane) {
    Places quarter;
    steps.locate(left, top, quarter);
    sample_job(*kernel_, sampling_.layout, {quarter, sources_[reading.mip_level], plane});
  });
  make_black(places, black, pixel_bytes_, target);
}

void PlaneSampler::sample(const Patch& patch, Reading reading, const TargetPlane& target) const {
  const auto sample = [&](const Patch& map, const SourcePlane& source, const TargetPlane& to) {
    if (!reading.in_windows || !has_blocks() || to.columns < kBlock) {
      sample_points(*kernel_, sampling_.layout, map, source, to);
    } else if (!sample_blocks(map, source, to)) {
      sample_steep(map, source, to);
    }
  };
  const Patch map = on_plane(patch, sampling_);
  if (!reading.averaged) return sample(map, sources_[0], target);
  const Patch fine = at_half_steps(map);
  oversample(sampling_.layout, target, [&](int left, int top, const TargetPlane& quarter) {
    const Patch part = left == 0 && top == 0 ? fine : moved(fine, left, top);
    sample(part, sources_[reading.mip_level], quarter);
  });
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
