// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/level_set.h"

#include <array>
#include <cstring>

namespace orbwatch::signals {
namespace {

using Pair = double __attribute__((vector_size(2 * sizeof(double))));

/// A blob's sums, in pairs in the order of PixelGeometry: compilers do not vectorize separate sums.
struct Pairs {
  Pair moment_xy{}, moment_z_solid_angle{}, position_xy{}, position_z_area{};

  [[gnu::always_inline]] void add(const PixelGeometry& pixel, double counts) {
    using Singles = float __attribute__((vector_size(2 * sizeof(float))));
    std::array<Singles, 4> singles;
    static_assert(sizeof singles == sizeof pixel);
    std::memcpy(singles.data(), &pixel, sizeof pixel);
    const double solid_angle = pixel.solid_angle, weight = solid_angle * counts;
    moment_xy += __builtin_convertvector(singles[0], Pair) * weight;
    moment_z_solid_angle += __builtin_convertvector(singles[1], Pair) * Pair{weight, 1};
    position_xy += __builtin_convertvector(singles[2], Pair) * solid_angle;
    position_z_area += __builtin_convertvector(singles[3], Pair) * Pair{solid_angle, 1};
  }
  void write(Blob& blob) const {
    blob.solid_angle = moment_z_solid_angle[1];
    blob.moment = {moment_xy[0], moment_xy[1], moment_z_solid_angle[0]};
    blob.area = position_z_area[1];
    blob.position = {position_xy[0], position_xy[1], position_z_area[0]};
  }
};

}  // namespace

template <class T>
struct LevelSet::Sums {
  Blob* blobs;
  const ImageView<const T>& values;
  const RegionGeometry& geometry;
  double threshold;

  void add(std::size_t run, const Span& span);
  void join(std::size_t kept, std::size_t joined);
};

template <class T>
void LevelSet::Sums<T>::add(std::size_t run, const Span& span) {
  const T* const row = values.row(span.y);
  const PixelGeometry* pixel = &geometry.at(span.begin, span.y);
  Pairs sums;
  T peak = row[span.begin];
  int peak_x = span.begin;
  for (int x = span.begin; x < span.end; ++x, ++pixel) {
    // Counts are relative to just below the threshold, so that a blob of equal values has a plain
    // centroid.
    sums.add(*pixel, row[x] - threshold + 1);
    if (row[x] > peak) {
      peak = row[x];
      peak_x = x;
    }
  }
  Blob& blob = blobs[run];
  sums.write(blob);
  blob.peak = peak;
  blob.peak_x = peak_x;
  blob.peak_y = span.y;
  blob.first = span;
}

template <class T>
void LevelSet::Sums<T>::join(std::size_t kept_index, std::size_t joined_index) {
  Blob& kept = blobs[kept_index];
  const Blob& joined = blobs[joined_index];
  kept.solid_angle += joined.solid_angle;
  kept.moment = kept.moment + joined.moment;
  kept.area += joined.area;
  kept.position = kept.position + joined.position;
  if (joined.peak > kept.peak) {
    kept.peak = joined.peak;
    kept.peak_x = joined.peak_x;
    kept.peak_y = joined.peak_y;
  }
}

template <class T>
void LevelSet::find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
                    double threshold, const Components& lower, std::size_t component,
                    const RegionGeometry& geometry) {
  components_.find(values, validity, threshold, lower, component,
                   Sums<T>{blobs_.data(), values, geometry, threshold});
}

template void LevelSet::find(const ImageView<const std::uint8_t>&,
                             const ImageView<const std::uint8_t>&, double, const Components&,
                             std::size_t, const RegionGeometry&);
template void LevelSet::find(const ImageView<const std::uint16_t>&,
                             const ImageView<const std::uint8_t>&, double, const Components&,
                             std::size_t, const RegionGeometry&);

}  // namespace orbwatch::signals
