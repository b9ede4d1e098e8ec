// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/image/result.h"
#include "proc/optics/view_projection.h"
#include "proc/signals/hot_spot/blob_pixels.h"
#include "proc/signals/hot_spot/blob_search.h"
#include "proc/signals/hot_spot/cooling.h"
#include "proc/signals/hot_spot/hot_spot.h"
#include "proc/signals/hot_spot/hot_spot_track.h"
#include "proc/signals/radiometry.h"
#include "proc/signals/region.h"
#include "proc/signals/signals.h"
#include "proc/signals/spatter.h"
#include "proc/signals/statistics.h"

namespace orbwatch::signals {

/// Measures one region of interest, frame set by frame set. Everything that depends on view, region
/// or calibration is compiled at construction; measuring allocates nothing, and computes
/// trigonometry only for the hot spot's angles, once per frame set. Movable. Thread-bound.
class RegionMeter {
 public:
  /// `sees`: see RegionMask; `memory`: see BlobSearch. Error: an outline that is not a polygon or
  /// outside of the view, thresholds out of range or in the wrong order, limits of the hot spot out
  /// of range or without the surface that they are on, radiometry out of range.
  static Result<RegionMeter> make(
      const optics::ViewProjection& view, const RegionScene& scene, const RegionSettings& settings,
      const RegionMask::Sees& sees = nullptr,
      std::shared_ptr<SearchMemory> memory = std::make_shared<SearchMemory>());
  /// The errors of make() without the memory that measuring needs.
  static Result<> check(const optics::ViewProjection& view, const RegionScene& scene,
                        const RegionSettings& settings, const RegionMask::Sees& sees = nullptr);
  RegionMeter(RegionMeter&&) = default;
  RegionMeter& operator=(RegionMeter&&) = default;
  RegionMeter(const RegionMeter&) = delete;  // a copy would lack the reserved memory
  RegionMeter& operator=(const RegionMeter&) = delete;

  /// The signals of a frame set. `values` and `validity` have the view's size; pixels that are not
  /// Validity::Seen do not count. `seconds`: its exposure on a monotonic clock; a time that does
  /// not increase acts as reset().
  Signals measure(const ImageView<const std::uint8_t>& values,
                  const ImageView<const std::uint8_t>& validity, double seconds);
  Signals measure(const ImageView<const std::uint16_t>& values,
                  const ImageView<const std::uint8_t>& validity, double seconds);

  /// Drops the state of earlier frame sets: statistics, sparks, hot spot.
  void reset();

  /// Conversion for thresholds; is_apparent() of it applies to the temperatures.
  const Radiometry& radiometry() const { return radiometry_; }

  /// Number of sparks since construction that were too many to be tracked; they are missing in
  /// spatter_rate.
  std::uint64_t untracked_sparks() const { return spatter_.untracked(); }

 private:
  /// Parts whose construction may fail.
  struct Parts {
    RegionMask mask;
    Radiometry radiometry;
  };

  static Result<Parts> make_parts(const optics::ViewProjection& view, const RegionScene& scene,
                                  const RegionSettings& settings, const RegionMask::Sees& sees);
  RegionMeter(const optics::ViewProjection& view, const RegionScene& scene,
              const RegionSettings& settings, Parts parts, std::shared_ptr<SearchMemory> memory);

  template <class T>
  Signals measure_any(const ImageView<const T>& values,
                      const ImageView<const std::uint8_t>& validity, double seconds);
  template <class T>
  void measure(const BlobSearch::Planes<T>& planes, const Blob& blob, Signals& signals);
  void write(const HotSpot& spot, const Blob& blob, Signals& signals) const;
  void add_statistics(Signals& signals, double seconds);

  RegionSettings settings_;
  optics::Vec3 ball_centre_;
  bool knows_surface_;
  RegionMask mask_;
  Radiometry radiometry_;
  RegionGeometry geometry_;
  BlobSearch search_;
  BlobPixels hot_pixels_;
  HotSpotTrack track_;
  BlobPixels plume_pixels_;
  CoolingMeter cooling_;
  std::optional<optics::Vec3> hot_direction_;
  SpatterTracker spatter_;
  std::array<Statistics, kMainSignals.size()> statistics_;
  double last_ = -std::numeric_limits<double>::infinity();
  /// The brightest pixel of the hot spot; the last hot spot's while there is none, -1 before the
  /// first.
  int peak_x_ = -1;
  int peak_y_ = -1;
};

}  // namespace orbwatch::signals
