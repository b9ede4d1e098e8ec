#pragma once

#include <cstddef>
#include <optional>

#include "proc/optics/vec.h"
#include "proc/signals/hot_spot/hot_spot_limits.h"
#include "proc/signals/hot_spot/level_set.h"

namespace orbwatch::signals {

/// Follows the hot spot from frame set to frame set: of the blobs that can be it, the largest near
/// its usual place. Behind a nozzle it is not seen, however large a spark is beside it; the way it
/// may have gone meanwhile grows until it is seen again, twice. Where it turns out to be elsewhere
/// it is believed once it has stayed there for longer than a spark lives. Work: linear in blobs. No
/// allocation. Thread-bound.
class HotSpotTrack {
 public:
  explicit HotSpotTrack(const HotSpotLimits& limits) : limits_(limits) {}

  /// The blob that is the hot spot, or LevelSet::kNone. `passed`: s since the call before; any for
  /// the first one.
  std::size_t follow(const LevelSet& hot, double passed);

  /// Of the blob that follow() returned, 0 to 1: a half when it is new, more for having been seen
  /// in the last frame sets; times how its size agrees with the usual one, and its share beside the
  /// largest other blob.
  double confidence() const { return confidence_; }

  void reset() { *this = HotSpotTrack(limits_); }

 private:
  /// Where something was seen last.
  struct Place {
    optics::Vec3 position;  ///< mm from the ball's centre
    double radius = 0;      ///< mm, of a disc of its usual area
    double ago = 0;         ///< s
  };
  /// A blob, and its size for the choice.
  struct Candidate {
    std::size_t blob = LevelSet::kNone;
    double weight = 0;
  };
  struct Candidates {
    Candidate largest, second;
    Candidate within_reach;  ///< the largest there
  };

  Candidates candidates(const LevelSet& hot) const;
  bool reaches(const std::optional<Place>& from, const Blob& blob) const;
  bool is_believed(const Blob& blob, bool is_within_reach, double passed);
  void keep(const Blob& blob, double share, double passed);
  void lose(double passed);

  HotSpotLimits limits_;
  std::optional<Place> last_;          ///< of the hot spot
  std::optional<optics::Vec3> usual_;  ///< unit vector to it in the last frame sets
  double usual_size_ = 0;              ///< steradian
  double seen_ = 0;                    ///< share of the last frame sets in which it was
  std::optional<Place> newcomer_;      ///< of what may be it, elsewhere or after a loss
  double newcomer_for_ = 0;            ///< s
  double confidence_ = 0;
};

}  // namespace orbwatch::signals
