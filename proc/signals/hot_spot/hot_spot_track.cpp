#include "proc/signals/hot_spot/hot_spot_track.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace orbwatch::signals {
namespace {

using optics::Vec3;

constexpr double kFollow = 0.1;    // s in which usual place and presence follow
constexpr double kFollowSize = 1;  // s; slower, so that what is half hidden does not look usual
constexpr double kBlink = 0.1;     // s without it until it is lost: a pulsed process flickers
constexpr double kSettled = 0.5;   // s; no spark flies for so long

/// How far an average over the last `span` s goes towards the newest value.
double step_of(double passed, double span) { return passed / (passed + span); }

Vec3 position_of(const Blob& blob) { return blob.position * (1 / blob.solid_angle); }

/// Of a disc.
double radius_of(double area) { return std::sqrt(area / std::numbers::pi); }

}  // namespace

std::size_t HotSpotTrack::follow(const LevelSet& hot, double passed) {
  const bool is_lost = limits_.max_speed < HotSpotLimits::kAny && last_ && last_->ago > kBlink;
  if (last_) last_->ago += passed;
  const auto [largest, second, within_reach] = candidates(hot);
  Candidate chosen = is_lost ? Candidate() : within_reach;
  const Candidate newcomer =
      is_lost && within_reach.blob != LevelSet::kNone ? within_reach : largest;
  if (newcomer.blob == chosen.blob) {
    newcomer_.reset();
  } else if (is_believed(hot.blob(newcomer.blob), newcomer.blob == within_reach.blob, passed)) {
    if (newcomer.blob != within_reach.blob) reset();
    chosen = newcomer;
  }
  if (chosen.blob == LevelSet::kNone) {
    lose(passed);
    return chosen.blob;
  }
  const double other = chosen.blob == largest.blob ? second.weight : largest.weight;
  keep(hot.blob(chosen.blob), chosen.weight / (chosen.weight + other), passed);
  return chosen.blob;
}

/// By size, weighted by the distance from the usual place, down to a ninth: a spark near the ball
/// may look larger than the pool.
HotSpotTrack::Candidates HotSpotTrack::candidates(const LevelSet& hot) const {
  constexpr double kNear = optics::radians(3);
  constexpr double kLeast = 1.0 / 9;
  Candidates found;
  for (std::size_t i = 0; i < hot.size(); ++i) {
    const Blob& blob = hot.blob(i);
    if (!hot.is_whole(i) || (limits_.min_area > 0 && !(blob.area >= limits_.min_area))) continue;
    Candidate candidate{i, blob.solid_angle};
    if (usual_) {
      const Vec3 apart = optics::normalized(blob.moment) - *usual_;
      candidate.weight *= std::max(kLeast, 1 / (1 + optics::dot(apart, apart) / (kNear * kNear)));
    }
    if (candidate.weight > found.within_reach.weight && reaches(last_, blob)) {
      found.within_reach = candidate;
    }
    if (candidate.weight > found.largest.weight) {
      found.second = std::exchange(found.largest, candidate);
    } else if (candidate.weight > found.second.weight) {
      found.second = candidate;
    }
  }
  return found;
}

/// A centroid also moves when a border is hidden or a spark touches it, by up to a radius.
bool HotSpotTrack::reaches(const std::optional<Place>& from, const Blob& blob) const {
  if (!from || limits_.max_speed == HotSpotLimits::kAny) return true;
  const double way = optics::norm(position_of(blob) - from->position);
  return way <= limits_.max_speed * from->ago + from->radius;
}

/// Of a blob that is not the hot spot of the frame set before: whether it is the same that the last
/// frame sets showed. A spark that flies through the reach of a lost hot spot is there only once.
bool HotSpotTrack::is_believed(const Blob& blob, bool is_within_reach, double passed) {
  if (newcomer_) newcomer_->ago = passed;
  const bool stays = newcomer_ && reaches(newcomer_, blob);
  newcomer_for_ = stays ? newcomer_for_ + passed : 0;
  newcomer_ = Place{position_of(blob), radius_of(blob.area)};
  return is_within_reach ? stays : newcomer_for_ >= kSettled;
}

/// `share`: beside the largest other blob.
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
