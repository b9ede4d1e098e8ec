// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/signals/hot_spot/blob_pixels.h"
#include "proc/signals/hot_spot/components.h"
#include "proc/signals/hot_spot/hot_spot_track.h"
#include "proc/signals/hot_spot/level_set.h"
#include "proc/signals/region.h"
#include "proc/signals/spatter.h"

namespace orbwatch::signals {

/// Finds the blobs of a region at its thresholds: one pass over its pixels for the lowest
/// threshold, then only where a blob at a higher one can matter. Work: linear in pixels, little for
/// each blob that does not matter. Allocates only at construction. Thread-bound.
class BlobSearch {
 public:
  BlobSearch(const RegionMask& mask, const RegionSettings& settings);

  /// The planes of the measured view.
  template <class T>
  struct Planes {
    const ImageView<const T>& values;
    const ImageView<const std::uint8_t>& validity;
  };

  /// Begins a frame set; the other calls must get the same planes.
  template <class T>
  void begin(const Planes<T>& planes, const RegionMask& mask);

  /// The hot spot chosen by `track`, `passed` s after the previous frame set.
  template <class T>
  std::optional<Blob> follow(const Planes<T>& planes, const RegionGeometry& geometry, double passed,
                             HotSpotTrack& track);

  /// Sets `pixels` to the blob at `threshold` around pixel (x, y); empty if there is none.
  template <class T>
  void assign(const Planes<T>& planes, double threshold, int x, int y, BlobPixels& pixels);

  /// Adds the sparks to `tracker`: blobs other than the one around pixel (x, y) and those in
  /// `hot_spot`, the result of assign() at its threshold. Precondition: a spatter threshold is set.
  template <class T>
  void add_sparks(const Planes<T>& planes, const RegionGeometry& geometry,
                  const BlobPixels& hot_spot, int x, int y, SpatterTracker& tracker);

 private:
  double hot_spot_threshold_;
  double spatter_threshold_;
  double lowest_threshold_;
  Components lowest_;
  Components around_;                 ///< components around a pixel
  std::optional<Components> sparks_;  ///< set if their threshold is not the lowest one
  LevelSet blobs_;
  std::vector<std::size_t> large_;  ///< components
};

}  // namespace orbwatch::signals
