#include "proc/remap/plane_sampler.h"

#include <algorithm>

#include "proc/remap/every_second.h"
#include "proc/remap/interpolation.h"
#include "proc/remap/oversampling.h"

namespace orbwatch::remap {
namespace {

using DenseSampling = void (*)(const CoordinateTile&, const SourcePlane&, std::uint8_t,
                               const TargetPlane&);
constexpr std::array<DenseSampling, kLayouts> kDenseSampling{
    sample_dense<Layout::One8>,        sample_dense<Layout::Two8>,
    sample_dense<Layout::Three8>,      sample_dense<Layout::Four8>,
    sample_dense<Layout::FirstOfTwo8>, sample_dense<Layout::OddOfFour8>,
    sample_dense<Layout::One16>,       sample_dense<Layout::Three16>};

constexpr std::size_t number(Layout layout) { return static_cast<std::size_t>(layout); }

SourcePlane plane_of_source(const Picture& picture, const PlaneSampling& sampling) {
  const auto& plane = picture.planes[sampling.plane];
  return {reinterpret_cast<const std::uint8_t*>(plane.data) + sampling.offset, plane.stride,
          picture.width >> shift(sampling.x), picture.height >> shift(sampling.y)};
}

/// Room for samples at half steps, most of which are only passed through.
struct FineSamples {
  alignas(64) std::array<std::uint8_t, kTile * kTile * 4> bytes;

  TargetPlane plane(int pixel_bytes, int columns, int rows) {
    return {bytes.data(), std::ptrdiff_t{kTile} * pixel_bytes, columns, rows};
  }
};

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

}  // namespace

PlaneSampler::PlaneSampler(const PlaneSampling& sampling, std::span<const Picture> pictures,
                           const Kernel& kernel)
    : sampling_(sampling),
      rounding_(BlockMap::rounding(added_u(sampling.layout), added_v(sampling.layout))),
      columns_(kTile >> shift(sampling.x)),
      rows_(kTile >> shift(sampling.y)),
      pixel_bytes_(info(sampling.layout).out_bytes()) {
  if (number(sampling.layout) < kKernelLayouts) kernel_ = kernel.tiles[number(sampling.layout)];
  for (std::size_t level = 0; level < std::min(pictures.size(), sources_.size()); ++level) {
    sources_[level] = plane_of_source(pictures[level], sampling);
  }
}

void PlaneSampler::sample(const CoordinateTile& coordinates, Halves halves, std::uint8_t black,
                          const TargetPlane& target) const {
  const DenseSampling sample_dense = kDenseSampling[number(sampling_.layout)];
  if (halves == kPlain) return sample_dense(coordinates, sources_[0], black, target);
  CoordinateTile quarter;
  oversample(sampling_.layout, target, [&](int left, int top, const TargetPlane& plane) {
    at_half_steps(coordinates, target.columns, target.rows, left, top, quarter);
    sample_dense(quarter, sources_[halves], black, plane);
    return true;
  });
}

/// Where samples are too far apart, or means are asked for.
bool PlaneSampler::sample_finely(const Patch& patch, Halves halves,
                                 const TargetPlane& target) const {
  if (halves == kPlain) return sample_steep(patch, sources_[0], target);
  const SourcePlane& source = sources_[halves];
  const Patch fine = at_half_steps(patch);
  const auto sample_quarter = [&](int left, int top, const TargetPlane& quarter) {
    const Patch part = moved(fine, left, top);
    return sample_blocks(part, source, quarter) || sample_steep(part, source, quarter);
  };
  return oversample(sampling_.layout, target, sample_quarter);
}

/// Blocks that do not fit their windows may do so at half the step, along one axis or both.
bool PlaneSampler::sample_steep(const Patch& patch, const SourcePlane& source,
                                const TargetPlane& target) const {
  return sample_half_rows(patch, source, target) || sample_half_columns(patch, source, target);
}

bool PlaneSampler::sample_half_rows(const Patch& patch, const SourcePlane& source,
                                    const TargetPlane& target) const {
  const Patch fine = at_half_rows(patch);
  FineSamples samples;
  for (int top = 0; top < 2 * target.rows; top += kTile) {
    const TargetPlane part = samples.plane(pixel_bytes_, target.columns, kTile);
    if (!sample_blocks(top == 0 ? fine : moved(fine, 0, top), source, part)) return false;
    take_every_second_row(
        part, target.columns * pixel_bytes_,
        {target.data + top / 2 * target.stride, target.stride, target.columns, kTile / 2});
  }
  return true;
}

/// A subsampled plane may be steep along x only. What is steep along both axes takes both.
bool PlaneSampler::sample_half_columns(const Patch& patch, const SourcePlane& source,
                                       const TargetPlane& target) const {
  const Patch fine = at_half_columns(patch);
  FineSamples samples;
  for (int left = 0; left < 2 * target.columns; left += kTile) {
    const Patch from_left = left == 0 ? fine : moved(fine, left, 0);
    const TargetPlane part = samples.plane(pixel_bytes_, kTile, target.rows);
    if (!sample_blocks(from_left, source, part) && !sample_half_rows(from_left, source, part)) {
      return false;
    }
    take_every_second_column(
        part, pixel_bytes_,
        {target.data + left / 2 * pixel_bytes_, target.stride, kTile / 2, target.rows});
  }
  return true;
}

}  // namespace orbwatch::remap
