// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/hot_spot.h"

#include <cmath>

namespace orbwatch::signals {
namespace {

using optics::Vec3;

/// A quantity of the geometry at a place with these bilinear weights.
template <class Quantity>
auto mean_of(const Corners& corners, const std::array<double, 4>& weights, Quantity quantity) {
  return quantity(*corners.geometry[0]) * weights[0] + quantity(*corners.geometry[1]) * weights[1] +
         quantity(*corners.geometry[2]) * weights[2] + quantity(*corners.geometry[3]) * weights[3];
}

Vec3 vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// Weighted sums up to the second order of a quantity that is linear over each piece.
struct Moments {
  double weight = 0;
  Vec3 first;
  Symmetric3 second;

  template <class Quantity>
  void add(const Piece& piece, const Corners& corners, const std::array<double, 4>& weights,
           double amount, Quantity quantity) {
    const Vec3 a = quantity(*corners.geometry[0]), b = quantity(*corners.geometry[1]);
    const Vec3 c = quantity(*corners.geometry[2]), d = quantity(*corners.geometry[3]);
    const Vec3 middle = a * weights[0] + b * weights[1] + c * weights[2] + d * weights[3];
    const Vec3 along_u = (b - a + c - d) * 0.5, along_v = (d - a + c - b) * 0.5;
    weight += amount;
    first = first + middle * amount;
    second.add(middle, amount);
    second.add(along_u, amount * piece.uu);
    second.add(along_v, amount * piece.vv);
    second.add(along_u, along_v, 2 * amount * piece.uv);
  }

  Vec3 mean() const { return first * (1 / weight); }
  PrincipalAxes axes() const {
    const Vec3 m = mean();
    Symmetric3 covariance = second;
    covariance.add(m, -weight);
    const double s = 1 / weight;
    return principal_axes({covariance.xx * s, covariance.yy * s, covariance.zz * s,
                           covariance.xy * s, covariance.xz * s, covariance.yz * s});
  }
};

Vec3 direction_of(const PixelGeometry& pixel) { return vec(pixel.direction); }
Vec3 position_of(const PixelGeometry& pixel) { return vec(pixel.position); }
double solid_angle_of(const PixelGeometry& pixel) { return pixel.solid_angle; }
double area_of(const PixelGeometry& pixel) { return pixel.area; }

template <class T>
double saturated_share(const ImageView<const T>& values, const BlobPixels& pixels,
                       double full_scale) {
  double all = 0, saturated = 0;
  for (const Span& span : pixels.spans()) {
    const T* row = values.row(span.y);
    for (int x = span.begin; x < span.end; ++x) saturated += row[x] >= full_scale ? 1 : 0;
    all += span.end - span.begin;
  }
  return saturated / all;
}

}  // namespace

template <class T>
HotSpot measure_hot_spot(const ImageView<const T>& values,
                         const ImageView<const std::uint8_t>& validity, const BlobPixels& pixels,
                         double threshold, double full_scale, const RegionGeometry& geometry,
                         const Radiometry& radiometry) {
  Moments angular, extent;
  double area = 0, counts = 0, celsius = 0;
  pixels.for_each_piece(
      values, validity, threshold, geometry, [&](const Piece& piece, const Corners& corners) {
        const auto weights = corner_weights(piece.u, piece.v);
        const double omega = piece.area * mean_of(corners, weights, solid_angle_of);
        const double mm2 = piece.area * mean_of(corners, weights, area_of);
        const double value = mean_of(weights, corners.counts);
        area += piece.area;
        counts += omega * value;
        if (radiometry.is_radiometric()) celsius += omega * radiometry.celsius(value);
        angular.add(piece, corners, weights, omega, direction_of);
        extent.add(piece, corners, weights, mm2, position_of);
      });
  HotSpot spot;
  if (!(angular.weight > 0)) return spot;
  spot.pixels = area;
  spot.solid_angle = angular.weight;
  spot.direction = optics::normalized(angular.first);
  spot.angular = angular.axes();
  spot.area = extent.weight;
  spot.position = extent.mean();
  spot.extent = extent.axes();
  spot.mean = counts / angular.weight;
  spot.mean_celsius = celsius / angular.weight;
  spot.saturated = saturated_share(values, pixels, full_scale);
  return spot;
}

template <class T>
double measure_solid_angle(const ImageView<const T>& values,
                           const ImageView<const std::uint8_t>& validity, const BlobPixels& pixels,
                           double threshold, const RegionGeometry& geometry) {
  double sum = 0;
  pixels.for_each_piece(
      values, validity, threshold, geometry, [&](const Piece& piece, const Corners& corners) {
        sum += piece.area * mean_of(corners, corner_weights(piece.u, piece.v), solid_angle_of);
      });
  return sum;
}

template HotSpot measure_hot_spot(const ImageView<const std::uint8_t>&,
                                  const ImageView<const std::uint8_t>&, const BlobPixels&, double,
                                  double, const RegionGeometry&, const Radiometry&);
template HotSpot measure_hot_spot(const ImageView<const std::uint16_t>&,
                                  const ImageView<const std::uint8_t>&, const BlobPixels&, double,
                                  double, const RegionGeometry&, const Radiometry&);
template double measure_solid_angle(const ImageView<const std::uint8_t>&,
                                    const ImageView<const std::uint8_t>&, const BlobPixels&, double,
                                    const RegionGeometry&);
template double measure_solid_angle(const ImageView<const std::uint16_t>&,
                                    const ImageView<const std::uint8_t>&, const BlobPixels&, double,
                                    const RegionGeometry&);

}  // namespace orbwatch::signals
