// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/spatter.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::signals {
namespace {

using optics::Vec3;

constexpr double kFastest = optics::radians(600);   // per s
constexpr double kSlack = optics::radians(1.5);     // error of a spark's position
constexpr double kOneSpark = optics::radians(2.5);  // largest distance between parts of one spark
/// Radians per s^2: gravity at a distance of a third of a metre, and its error for sparks nearer or
/// farther.
constexpr double kGravity = 9.81 / 0.33;
constexpr double kGravityError = 0.5 * kGravity;
constexpr double kBend = 0.3;          // share of a step by which the next one may differ
constexpr double kNearest = 0.2;       // weight of nearness while the speed is unknown
constexpr double kLongestMiss = 0.07;  // s, unless one frame set is longer
constexpr double kSegment = 0.05;      // s, shortest time over which a speed is measured
constexpr double kLongestGap = 0.25;  // s between frame sets; all sparks are new after a longer one
constexpr double kBinWidth = 50;      // deg/s

/// The part of -Z across a direction.
Vec3 down(const Vec3& direction) { return direction * direction.z - Vec3{0, 0, 1}; }

/// The angle of a chord between two unit vectors, to 1e-4 of it up to 40 degrees.
double angle_of_chord(double chord) { return chord * (1 + chord * chord / 24); }

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = optics::norm(v);
  return length > 0 ? v * (1 / length) : otherwise;
}

}  // namespace

SpatterTracker::SpatterTracker() {
  tracks_.reserve(kMaxSparks);
  candidates_.reserve(kMaxSparks * kMaxSparks);
  sparks_.reserve(kMaxSparks);
}

void SpatterTracker::reset() {
  tracks_.clear();
  bins_.clear();
  sparks_.clear();
  parts_ = 0;
  beyond_ = 0;
}

void SpatterTracker::add(const Vec3& moment) {
  if (parts_ == kMaxSparkParts) {
    ++beyond_;
    return;
  }
  ++parts_;
  comparisons_ += sparks_.size();
  const Vec3 direction = optics::normalized(moment);
  const auto same = std::ranges::find_if(sparks_, [&](const Spark& spark) {
    const Vec3 apart = spark.direction - direction;
    return optics::dot(apart, apart) < kOneSpark * kOneSpark;
  });
  if (same != sparks_.end()) {
    same->moment = same->moment + moment;
    same->direction = optics::normalized(same->moment);
  } else if (sparks_.size() < kMaxSparks) {
    sparks_.push_back({moment, direction});
  } else {
    ++beyond_;
  }
}

/// Cost of a continuation; above 1 a spark does not continue that track.
double SpatterTracker::cost(const Track& track, const Vec3& spark, double now) {
  const double passed = now - track.seen;
  const Vec3 step = spark - track.direction;
  const double length = optics::norm(step);
  if (length > kFastest * passed + kSlack) return 2;
  // The velocity is half an interval old.
  const double fall = passed * (passed + track.interval) / 2;
  const double bend = kSlack + kGravityError * fall;
  if (track.detections > 1) {
    const Vec3 expected = track.velocity * passed + down(track.direction) * (kGravity * fall);
    return optics::norm(step - expected) / (bend + kBend * optics::norm(expected));
  }
  if (!track.has_origin) return length / (kFastest * passed + kSlack);
  // Without a velocity the spark is expected on the line from the hot spot.
  const Vec3 came = track.direction - track.origin;
  const Vec3 way = unit_or(came, unit_or(step, came));
  const double along = optics::dot(step, way);
  const double aside = along > 0 ? optics::norm(step - way * along) : length;
  return aside / (bend + kBend * length) + kNearest * length / (kFastest * passed + kSlack);
}

void SpatterTracker::update(double now, const std::optional<Vec3>& hot_spot) {
  bins_.advance(now);
  if (now - time_ > kLongestGap) tracks_.clear();
  time_ = now;
  match(now);
  std::erase_if(tracks_, [&](Track& track) {
    if (track.matched) return false;
    const bool lost =
        track.detections < 2 || (++track.missed > 1 && now - track.seen > kLongestMiss);
    if (lost) end(track, now);
    return lost;
  });
  add_tracks(now, hot_spot);
  count_ = sparks_.size() + beyond_;
  lose(beyond_, now);
  parts_ = 0;
  beyond_ = 0;
  sparks_.clear();
}

/// Assigns sparks to tracks, the best pairs first.
void SpatterTracker::match(double now) {
  comparisons_ += tracks_.size() * sparks_.size();
  candidates_.clear();
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    tracks_[t].matched = false;
    for (std::size_t s = 0; s < sparks_.size(); ++s) {
      const double price = cost(tracks_[t], sparks_[s].direction, now);
      if (price > 1) continue;
      candidates_.push_back({price, static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(s)});
    }
  }
  std::ranges::sort(candidates_, {}, &Candidate::cost);
  for (const Candidate& candidate : candidates_) {
    Track& track = tracks_[candidate.track];
    Spark& spark = sparks_[candidate.spark];
    if (track.matched || spark.matched) continue;
    spark.matched = true;
    extend(track, spark.direction, now);
  }
}

void SpatterTracker::add_tracks(double now, const std::optional<Vec3>& hot_spot) {
  for (const Spark& spark : sparks_) {
    if (spark.matched) continue;
    if (tracks_.size() == kMaxSparks) {
      lose(1, now);
      continue;
    }
    Track track;
    track.direction = spark.direction;
    track.has_origin = hot_spot.has_value();
    track.origin = hot_spot.value_or(Vec3{});
    track.measured_from = spark.direction;
    track.seen = track.first = track.measured = now;
    tracks_.push_back(track);
    bins_.at(now).born += 1;
  }
}

void SpatterTracker::extend(Track& track, const Vec3& spark, double now) {
  const Vec3 step = spark - track.direction;
  track.interval = now - track.seen;
  track.velocity = step * (1 / track.interval);
  track.direction = spark;
  track.seen = now;
  track.missed = 0;
  track.matched = true;
  if (now - track.measured >= kSegment) measure_path(track);
  ++track.detections;
}

/// Adds the segment up to the last detection.
void SpatterTracker::measure_path(Track& track) {
  track.path += angle_of_chord(optics::norm(track.direction - track.measured_from));
  track.measured_from = track.direction;
  track.measured = track.seen;
}

void SpatterTracker::end(Track& track, double now) {
  if (track.detections < 2) return;
  if (track.path == 0) measure_path(track);
  const double speed = optics::degrees(track.path) / (track.measured - track.first);
  Bin& bin = bins_.at(now);
  bin.ended += 1;
  bin.speed += speed;
  bin.by_speed[std::min(kBins - 1, static_cast<std::size_t>(speed / kBinWidth))] += 1;
}

void SpatterTracker::lose(std::size_t sparks, double now) {
  if (sparks == 0) return;
  untracked_ += sparks;
  bins_.at(now).untracked += static_cast<double>(sparks);
}

void SpatterTracker::write(Signals& signals) const {
  Bin all;
  bins_.for_each([&](const Bin& bin) {
    all.born += bin.born;
    all.ended += bin.ended;
    all.speed += bin.speed;
    all.untracked += bin.untracked;
    for (std::size_t i = 0; i < kBins; ++i) all.by_speed[i] += bin.by_speed[i];
  });
  signals.spatter_count = static_cast<double>(count_);
  signals.spatter_rate = all.born;
  signals.spatter_untracked = all.untracked;
  if (all.ended > 0) signals.spatter_speed = all.speed / all.ended;
  signals.spatter_speed_0 = all.by_speed[0];
  signals.spatter_speed_50 = all.by_speed[1];
  signals.spatter_speed_100 = all.by_speed[2];
  signals.spatter_speed_150 = all.by_speed[3];
  signals.spatter_speed_200 = all.by_speed[4];
  signals.spatter_speed_250 = all.by_speed[5];
  signals.spatter_speed_300 = all.by_speed[6];
  signals.spatter_speed_350 = all.by_speed[7];
}

}  // namespace orbwatch::signals
