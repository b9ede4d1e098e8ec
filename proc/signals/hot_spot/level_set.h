// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/untouched_memory.h"
#include "proc/optics/vec.h"
#include "proc/signals/hot_spot/components.h"
#include "proc/signals/region.h"

namespace orbwatch::signals {

/// Sums of a component of pixels at or above a threshold.
struct Blob {
  double solid_angle = 0;  ///< steradian, of whole pixels
  /// Sum of directions weighted by solid angle and counts above the threshold.
  optics::Vec3 moment;
  double area = 0;        ///< mm2 of the machine's surface; NaN if far
  optics::Vec3 position;  ///< mm from the ball's centre, weighted by solid angle; NaN if far
  int peak = 0;           ///< counts of its brightest pixel, and that pixel's place
  int peak_x = 0;
  int peak_y = 0;
  Span first;  ///< its uppermost run, the left one if several: identifies the blob
};

/// Measures the blobs within a component of a lower threshold: sums cost more than finding, and
/// where noise makes thousands of blobs only few of them matter. Allocates only in reserve().
/// Thread-bound.
class LevelSet {
 public:
  /// Makes room for any blobs of the region; those found before are lost.
  void reserve(const RegionMask& mask) {
    components_.reserve(mask);
    make_room(blobs_, mask.most_runs());
  }

  /// Finds blobs at or above `threshold`, counts; the other arguments are those of
  /// Components::find().
  template <class T>
  void find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
            double threshold, const Components& lower, std::size_t component,
            const RegionGeometry& geometry);

  /// Calls visit(blob) in the order of their first runs.
  template <class Visit>
  void for_each_blob(const Visit& visit) const {
    for (std::size_t i = 0; i < components_.runs().size(); ++i) {
      if (components_.pixels(i) > 0) visit(blobs_[i]);
    }
  }

 private:
  template <class T>
  struct Sums;

  Components components_;
  UntouchedVector<Blob> blobs_;  ///< indexed by run; set for components
};

}  // namespace orbwatch::signals
