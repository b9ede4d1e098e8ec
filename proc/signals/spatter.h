// SPDX-License-Identifier: Apache-2.0
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

/// Most sparks that are tracked at once.
inline constexpr std::size_t kMaxSparks = 128;

/// Most parts of sparks in a frame set; each is compared with every spark.
inline constexpr std::size_t kMaxSparkParts = 8 * kMaxSparks;

/// Tracks sparks from frame set to frame set, so that each counts once and has a speed. Speeds are
/// those of directions, deg/s: one ball does not measure the distance of a spark.
///
/// A spark is predicted along a great circle with its last velocity; the detection nearest to the
/// prediction, within bounds for gravity and errors, continues its track. A track with one
/// detection is assumed to start at the hot spot. It survives a gap of one frame set or 0.07 s, for
/// example behind another spark. Allocates only at construction; no trigonometry. Thread-bound.
class SpatterTracker {
 public:
  SpatterTracker();

  /// Adds a detection to the frame set that update() completes: a spark or a part of one, as its
  /// direction times its weight. Parts that are very near are one spark: pixels of a ball's picture
  /// are large, and edges of the machine's surfaces separate them in a view.
  void add(const optics::Vec3& moment);

  /// Adds `parts` more, by number only: those beyond kMaxSparkParts are not compared.
  void add_beyond(std::size_t parts) { beyond_ += parts; }

  /// Continues the tracks with the detections since the last call. `now`: s; `hot_spot`: unit
  /// vector to it, if there is one.
  void update(double now, const std::optional<optics::Vec3>& hot_spot);

  void reset();

  /// Writes the number of sparks in the frame set, and rate and speeds of the last second.
  void write(Signals& signals) const;

  /// Sparks since the start that were neither tracked nor counted as new: more than kMaxSparks at
  /// once, or parts beyond kMaxSparkParts.
  std::uint64_t untracked() const { return untracked_; }

  /// Pairs of parts, sparks or tracks compared since the start: the work. At most kMaxSparks
  /// (kMaxSparkParts + kMaxSparks) in a frame set.
  std::uint64_t comparisons() const { return comparisons_; }

 private:
  static constexpr std::size_t kBins = 8;

  struct Track {
    optics::Vec3 direction;
    optics::Vec3 velocity;  ///< 1/s, across the direction; 0 until detected twice
    optics::Vec3 origin;    ///< start of a track without a velocity yet: the hot spot
    bool has_origin = false;
    int detections = 1;
    int missed = 0;
    double seen = 0;      ///< s, time of the last detection
    double interval = 0;  ///< s, between the last two detections
    double first = 0;     ///< s, time of the first detection
    // Speed is measured over segments long enough for the error of a position to be small.
    optics::Vec3 measured_from;  ///< start of the current segment
    double measured = 0;         ///< s, of that start
    double path = 0;             ///< radians
    bool matched = false;
  };
  struct Candidate {
    double cost;  ///< distance from the prediction, as a share of the allowed one
    std::uint32_t track;
    std::uint32_t spark;
  };
  /// Sums over a part of the last second.
  struct Bin {
    double born = 0;
    double ended = 0;  ///< sparks ended that had been seen at least twice
    double speed = 0;  ///< sum of their speeds, deg/s
    double untracked = 0;
    std::array<double, kBins> by_speed{};
  };

  /// A spark of the current frame set.
  struct Spark {
    optics::Vec3 moment;
    optics::Vec3 direction;
    bool matched = false;
  };

  static double cost(const Track& track, const optics::Vec3& spark, double now);
  void match(double now);
  void add_tracks(double now, const std::optional<optics::Vec3>& hot_spot);
  void extend(Track& track, const optics::Vec3& spark, double now);
  static void measure_path(Track& track);
  void end(Track& track, double now);
  void lose(std::size_t sparks, double now);

  std::vector<Track> tracks_;
  std::vector<Candidate> candidates_;
  std::vector<Spark> sparks_;
  std::size_t parts_ = 0;   ///< number in the current frame set
  std::size_t beyond_ = 0;  ///< sparks and parts of the current frame set that are too many
  std::size_t count_ = 0;   ///< number in the last frame set
  LastSecond<Bin> bins_;
  double time_ = 0;
  std::uint64_t untracked_ = 0;
  std::uint64_t comparisons_ = 0;
};

}  // namespace orbwatch::signals
