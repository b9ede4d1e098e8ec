// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/optics/vec.h"
#include "proc/signals/hot_spot/blob_pixels.h"
#include "proc/signals/hot_spot/principal_axes.h"
#include "proc/signals/radiometry.h"

namespace orbwatch::signals {

/// The hot spot of one frame set, measured to a fraction of a pixel. Lengths are those on the
/// machine's surface, and NaN where that is not known.
struct HotSpot {
  double pixels = 0;
  double solid_angle = 0;   ///< steradian
  optics::Vec3 direction;   ///< unit vector to the centroid
  PrincipalAxes angular;    ///< variances of directions, square radians
  double area = 0;          ///< mm2
  optics::Vec3 position;    ///< its centroid, mm from the ball's centre
  PrincipalAxes extent;     ///< variances of positions, mm2
  double mean = 0;          ///< counts, weighted by solid angle
  double mean_celsius = 0;  ///< weighted by solid angle; NaN unless radiometric
  double saturated = 0;     ///< share of its pixels
};

/// Measures the blob in `pixels`, which holds at least one and was found with `threshold`.
/// `full_scale`: counts of a saturated pixel. No allocation. Reentrant.
template <class T>
HotSpot measure_hot_spot(const ImageView<const T>& values,
                         const ImageView<const std::uint8_t>& validity, const BlobPixels& pixels,
                         double threshold, double full_scale, const RegionGeometry& geometry,
                         const Radiometry& radiometry);

/// The solid angle alone, steradian.
template <class T>
double measure_solid_angle(const ImageView<const T>& values,
                           const ImageView<const std::uint8_t>& validity, const BlobPixels& pixels,
                           double threshold, const RegionGeometry& geometry);

}  // namespace orbwatch::signals
