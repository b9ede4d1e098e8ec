// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/untouched_memory.h"
#include "proc/signals/hot_spot/blob_pixels.h"
#include "proc/signals/radiometry.h"

namespace orbwatch::signals {

/// Cooling rate of the area that has just left the hot spot: the mean, by solid angle, of the fall
/// of temperature between two frame sets over the part that was above the threshold in the first
/// one and no longer is in the second, to a fraction of a pixel. If the threshold is the melting
/// point, that is gradient times speed of solidification along the pool's tail (Kurz, Fisher:
/// Fundamentals of solidification). No model of the profile is assumed. A pixel shows one place of
/// the machine, so the rate is that of the material there. Allocates only at construction.
/// Thread-bound.
class CoolingMeter {
 public:
  CoolingMeter(const RegionMask& mask, double threshold);

  /// The rate, K/s; stores the hot spot in `pixels`, which may be empty, for the next call. `now`
  /// in s. NaN when nothing has left it, or the previous call is longer ago than a quarter second.
  template <class T>
  double update(double now, const ImageView<const T>& values,
                const ImageView<const std::uint8_t>& validity, const BlobPixels& pixels,
                const RegionGeometry& geometry, const Radiometry& radiometry);

  void reset() { before_.clear(); }

 private:
  template <class T>
  double fall(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
              const RegionGeometry& geometry, const Radiometry& radiometry) const;
  template <class T>
  void remember(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
                const BlobPixels& pixels);

  double threshold_;
  // Previous frame set: its hot spot, and the planes there.
  double time_ = 0;
  BlobPixels before_;
  int stride_;
  int height_;
  UntouchedVector<std::uint16_t> values_;  ///< set where before_ has pixels and beside them
  UntouchedVector<std::uint8_t> validity_;
};

}  // namespace orbwatch::signals
