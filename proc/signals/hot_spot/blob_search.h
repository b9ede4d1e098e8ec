// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
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

/// Memory of a BlobSearch for one region and frame set. Regions that are measured one after another
/// share it. Thread-bound.
struct SearchMemory {
  Components lowest;
  Components around;  ///< components around a pixel
  Components sparks;  ///< empty if their threshold is the lowest one in every region
  LevelSet blobs;
  std::vector<std::size_t> large;  ///< components
};

/// Finds the blobs of a region at its thresholds: one pass over its pixels for the lowest
/// threshold, then only where a blob at a higher one can matter. Work: linear in pixels, little for
/// each blob that does not matter. Allocates only at construction. Thread-bound.
class BlobSearch {
 public:
  /// `memory` grows to what the region needs; between begin() and the last call for a frame set
  /// no other search may use it.
  BlobSearch(const RegionMask& mask, const RegionSettings& settings,
             std::shared_ptr<SearchMemory> memory = std::make_shared<SearchMemory>());

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
  std::shared_ptr<SearchMemory> memory_;
};

}  // namespace orbwatch::signals
