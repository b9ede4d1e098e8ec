// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/hot_spot_track.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace orbwatch::signals {
namespace {

using optics::Vec3;

constexpr double kFollow = 0.1;  // s; time constant of usual place and presence
// Seconds; slower, so that a half hidden spot does not become the usual one.
constexpr double kFollowSize = 1;
constexpr double kBlink = 0.1;    // s without it until it is lost: a pulsed process flickers
constexpr double kSettled = 0.5;  // s; no spark flies for so long

/// Weight of the newest value in an average over the last `span` s.
double step_of(double passed, double span) { return passed / (passed + span); }

Vec3 position_of(const Blob& blob) { return blob.position * (1 / blob.solid_angle); }

/// Radius of a disc.
double radius_of(double area) { return std::sqrt(area / std::numbers::pi); }

}  // namespace

bool HotSpotTrack::Candidate::is_blob_of(const Candidate& other) const {
  const Span &a = blob.first, &b = other.blob.first;
  return weight > 0 ? other.weight > 0 && a.y == b.y && a.begin == b.begin : !(other.weight > 0);
}

/// The upper one of two equal blobs is heavier, then the left one, in whatever order they were
/// added.
bool HotSpotTrack::Candidate::is_heavier_than(const Candidate& other) const {
  if (weight != other.weight) return weight > other.weight;
  const Span &a = blob.first, &b = other.blob.first;
  return weight > 0 && std::pair(a.y, a.begin) < std::pair(b.y, b.begin);
}

void HotSpotTrack::begin(double passed) {
  passed_ = passed;
  is_lost_ = limits_.max_speed < HotSpotLimits::kAny && last_ && last_->ago > kBlink;
  if (last_) last_->ago += passed;
  candidates_ = {};
}

/// Compares by size, weighted by the distance from the usual place, down to a ninth: a spark near
/// the ball may look larger than the pool.
void HotSpotTrack::consider(const Blob& blob) {
  constexpr double kNear = optics::radians(3);
  constexpr double kLeast = 1.0 / 9;
  auto& [largest, second, within_reach] = candidates_;
  if (blob.solid_angle < std::min(second.weight, within_reach.weight)) return;
  if (limits_.min_area > 0 && !(blob.area >= limits_.min_area)) return;
  Candidate candidate{blob.solid_angle, blob};
  if (usual_) {
    const Vec3 apart = optics::normalized(blob.moment) - *usual_;
    candidate.weight *= std::max(kLeast, 1 / (1 + optics::dot(apart, apart) / (kNear * kNear)));
  }
  if (candidate.is_heavier_than(within_reach) && reaches(last_, blob)) within_reach = candidate;
  if (candidate.is_heavier_than(largest)) {
    second = std::exchange(largest, candidate);
  } else if (candidate.is_heavier_than(second)) {
    second = candidate;
  }
}

/// A blob's weight is never above its solid angle.
bool HotSpotTrack::is_settled(double solid_angle, double area) const {
  if (area < limits_.min_area) return true;
  return std::min(candidates_.second.weight, candidates_.within_reach.weight) >= solid_angle;
}

std::optional<Blob> HotSpotTrack::choose() {
  const double passed = passed_;
  const auto [largest, second, within_reach] = candidates_;
  Candidate chosen = is_lost_ ? Candidate() : within_reach;
  const Candidate& newcomer = is_lost_ && within_reach ? within_reach : largest;
  if (newcomer.is_blob_of(chosen)) {
    newcomer_.reset();
  } else if (is_believed(newcomer.blob, newcomer.is_blob_of(within_reach), passed)) {
    if (!newcomer.is_blob_of(within_reach)) reset();
    chosen = newcomer;
  }
  if (!chosen) {
    lose(passed);
    return std::nullopt;
  }
  const double other = chosen.is_blob_of(largest) ? second.weight : largest.weight;
  keep(chosen.blob, chosen.weight / (chosen.weight + other), passed);
  return chosen.blob;
}

/// A centroid also moves when a border is hidden or a spark touches it, by up to a radius.
bool HotSpotTrack::reaches(const std::optional<Place>& from, const Blob& blob) const {
  if (!from || limits_.max_speed == HotSpotLimits::kAny) return true;
  const double way = optics::norm(position_of(blob) - from->position);
  return way <= limits_.max_speed * from->ago + from->radius;
}

/// True if a blob other than the previous hot spot is the same as in the last frame sets. A spark
/// that flies through the reach of a lost hot spot is there only once.
bool HotSpotTrack::is_believed(const Blob& blob, bool is_within_reach, double passed) {
  if (newcomer_) newcomer_->ago = passed;
  const bool stays = newcomer_ && reaches(newcomer_, blob);
  newcomer_for_ = stays ? newcomer_for_ + passed : 0;
  newcomer_ = Place{position_of(blob), radius_of(blob.area)};
  return is_within_reach ? stays : newcomer_for_ >= kSettled;
}

/// `share`: its share beside the largest other blob.
void HotSpotTrack::keep(const Blob& blob, double share, double passed) {
  const Vec3 direction = optics::normalized(blob.moment);
  const double size = blob.solid_angle;
  if (!usual_) {
    usual_ = direction;
    usual_size_ = size;
  }
  const double smaller = std::min(size, usual_size_), larger = std::max(size, usual_size_);
  confidence_ = (1 + seen_) / 2 * share * smaller / larger;
  last_ = Place{position_of(blob), radius_of(blob.area * larger / size)};
  usual_ = optics::normalized(*usual_ + (direction - *usual_) * step_of(passed, kFollow));
  usual_size_ += (size - usual_size_) * step_of(passed, kFollowSize);
  seen_ += (1 - seen_) * step_of(passed, kFollow);
}

void HotSpotTrack::lose(double passed) {
  seen_ -= seen_ * step_of(passed, kFollow);
  confidence_ = 0;
}

}  // namespace orbwatch::signals
