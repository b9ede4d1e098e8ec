#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "proc/optics/vec.h"
#include "proc/signals/last_second.h"
#include "proc/signals/signals.h"

namespace orbwatch::signals {

/// Sparks that are followed at once.
inline constexpr std::size_t kMaxSparks = 128;

/// Follows sparks from frame set to frame set, so that each counts once and has a speed. Speeds are
/// those of directions, deg/s: how far away a spark flies, one ball cannot know.
///
/// A spark goes on along a great circle as fast as it came; what is nearest to where it should be,
/// within reach of its gravity and of errors, is taken for it. One that was seen only once is taken
/// to come from the hot spot. It stays when it is missed for a frame set or 0.07 s, as behind
/// another one. All memory is taken when it is made; no trigonometry. Thread-bound.
class SpatterTracker {
 public:
  SpatterTracker();

  /// Takes a spark, or a part of one, of the frame set that update() will follow: its direction
  /// times its weight. Parts that are very near are one: pixels of a ball's picture are large, and
  /// where the machine's surfaces have edges they stand apart in a view.
  void see(const optics::Vec3& moment);

  /// Follows what was seen since it was called before. `now`: s; `hot_spot`: unit vector to it, if
  /// there is one.
  void update(double now, const std::optional<optics::Vec3>& hot_spot);

  void reset();

  /// Writes the number of sparks in the frame set, and rate and speeds of the last second.
  void write(Signals& signals) const;

  /// Sparks since the start that were seen but not followed, nor counted as new: more than
  /// kMaxSparks at once.
  std::uint64_t untracked() const { return untracked_; }

 private:
  static constexpr std::size_t kBins = 8;

  struct Track {
    optics::Vec3 direction;
    optics::Vec3 velocity;  ///< 1/s, across the direction; 0 until seen twice
    optics::Vec3 origin;    ///< where it came from when it has no velocity yet: the hot spot
    bool has_origin = false;
    int sightings = 1;
    int missed = 0;
    double seen = 0;      ///< s, when last
    double interval = 0;  ///< s, between the last two sightings
    double first = 0;     ///< s
    // Speed is measured over stretches long enough for the error of a place to be small.
    optics::Vec3 measured_from;  ///< where the current stretch begins
    double measured = 0;         ///< s, when
    double path = 0;             ///< radians
    bool matched = false;
  };
  struct Candidate {
    double cost;  ///< distance from where it should be, as a share of what is allowed
    std::uint32_t track;
    std::uint32_t spark;
  };
  /// What happened in a part of the last second.
  struct Bin {
    double born = 0;
    double ended = 0;  ///< that had been seen at least twice
    double speed = 0;  ///< their sum, deg/s
    std::array<double, kBins> by_speed{};
  };

  /// Of the current frame set.
  struct Spark {
    optics::Vec3 moment;
    optics::Vec3 direction;
    bool taken = false;
  };

  static double cost(const Track& track, const optics::Vec3& spark, double now);
  void match(double now);
  void add_tracks(double now, const std::optional<optics::Vec3>& hot_spot);
  void take(Track& track, const optics::Vec3& spark, double now);
  static void measure_path(Track& track);
  void end(Track& track, double now);

  std::vector<Track> tracks_;
  std::vector<Candidate> candidates_;
  std::vector<Spark> sparks_;
  std::size_t beyond_ = 0;  ///< sparks of the current frame set beyond kMaxSparks
  std::size_t count_ = 0;   ///< of the last frame set
  LastSecond<Bin> bins_;
  double time_ = 0;
  std::uint64_t untracked_ = 0;
};

}  // namespace orbwatch::signals
