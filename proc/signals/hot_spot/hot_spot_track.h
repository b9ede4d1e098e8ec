// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "proc/optics/vec.h"
#include "proc/signals/hot_spot/hot_spot_limits.h"
#include "proc/signals/hot_spot/level_set.h"

namespace orbwatch::signals {

/// Follows the hot spot from frame set to frame set: it is the largest blob near its usual place,
/// of those that can be it. Behind a nozzle it is not seen, however large a spark is beside it; the
/// distance that it may have moved meanwhile grows until it is seen again, twice. A hot spot at
/// another place is accepted once it has stayed there for longer than a spark lives. Work: linear
/// in blobs. No allocation. Thread-bound.
class HotSpotTrack {
 public:
  explicit HotSpotTrack(const HotSpotLimits& limits) : limits_(limits) {}

  /// Begins a frame set, `passed` s after the previous one; any value for the first one.
  void begin(double passed);

  /// Adds a blob of the frame set, in any order.
  void consider(const Blob& blob);

  /// True if no blob below that solid angle, steradian, and that area, mm2, could change the result
  /// of choose() or the state kept for the next frame set.
  bool is_settled(double solid_angle, double area) const;

  /// The blob that is the hot spot, if there is one. Ends the frame set.
  std::optional<Blob> choose();

  /// Confidence of the blob that choose() returned, 0 to 1: a half when it is new, more for having
  /// been seen in the last frame sets; times the agreement of its size with the usual one, and its
  /// share beside the largest other blob.
  double confidence() const { return confidence_; }

  void reset() { *this = HotSpotTrack(limits_); }

 private:
  /// Place of the last sighting.
  struct Place {
    optics::Vec3 position;  ///< mm from the ball's centre
    double radius = 0;      ///< mm, radius of a disc of its usual area
    double ago = 0;         ///< s
  };
  /// A blob, and its size for the choice: 0 for none.
  struct Candidate {
    double weight = 0;
    Blob blob{};

    explicit operator bool() const { return weight > 0; }
    bool is_blob_of(const Candidate& other) const;
    bool is_heavier_than(const Candidate& other) const;
  };
  struct Candidates {
    Candidate largest, second;
    Candidate within_reach;  ///< the largest one within reach
  };

  bool reaches(const std::optional<Place>& from, const Blob& blob) const;
  bool is_believed(const Blob& blob, bool is_within_reach, double passed);
  void keep(const Blob& blob, double share, double passed);
  void lose(double passed);

  HotSpotLimits limits_;
  // State of the frame set.
  double passed_ = 0;
  bool is_lost_ = false;
  Candidates candidates_;
  // State kept between frame sets.
  std::optional<Place> last_;          ///< the hot spot's last place
  std::optional<optics::Vec3> usual_;  ///< unit vector to it in the last frame sets
  double usual_size_ = 0;              ///< steradian
  double seen_ = 0;                    ///< share of the last frame sets in which it was seen
  std::optional<Place> newcomer_;      ///< place of a possible hot spot, elsewhere or after a loss
  double newcomer_for_ = 0;            ///< s
  double confidence_ = 0;
};

}  // namespace orbwatch::signals
