#include "proc/remap/sampling/point_sampling.h"

#include <algorithm>
#include <cstddef>

namespace orbwatch::remap {
namespace {

/// Only the scalar kernel samples planes that are one pixel wide or high.
void sample(const Kernel& kernel, Layout layout, const PointJob& job) {
  const bool has_neighbours = job.source.width > 1 && job.source.height > 1;
  (has_neighbours ? kernel : scalar_kernel()).sample_points(layout, job);
}

void make_black(const CoordinateTile& coordinates, std::uint8_t black, int pixel_bytes,
                const TargetPlane& target) {
  for (int y = 0; y < target.rows; ++y) {
    std::uint8_t* const row = target.data + y * target.stride;
    for (int x = 0; x < target.columns; ++x) {
      if (!is_defined(coordinates[y][x])) std::fill_n(row + x * pixel_bytes, pixel_bytes, black);
    }
  }
}

}  // namespace

void sample_points(const Kernel& kernel, Layout layout, const Patch& patch,
                   const SourcePlane& source, const TargetPlane& target) {
  Places places;
  kernel.locate(PointMap(patch), target.columns, target.rows, places);
  sample(kernel, layout, {places, source, target});
}

void sample_points(const Kernel& kernel, Layout layout, const CoordinateTile& coordinates,
                   std::uint8_t black, const SourcePlane& source, const TargetPlane& target) {
  Places places;
  std::size_t count = 0;
  for (int y = 0; y < target.rows; ++y) {
    for (int x = 0; x < target.columns; ++x, ++count) {
      places.u[count] = coordinates[y][x].u;
      places.v[count] = coordinates[y][x].v;
    }
  }
  for (; count % kPointRun != 0; ++count) places.u[count] = places.v[count] = 0;
  sample(kernel, layout, {places, source, target});
  make_black(coordinates, black, info(layout).out_bytes(), target);
}

}  // namespace orbwatch::remap
