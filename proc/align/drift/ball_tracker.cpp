// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/ball_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "proc/align/drift/fault.h"
#include "proc/align/drift/reference_picture.h"

namespace orbwatch::align {
namespace {

using optics::Outline;
using optics::Vec2;

/// The ball's largest radius at the finest scale, px; a hundredth of a pixel is enough there.
constexpr double kFinest = 450;
/// A scale with a smaller ball is the coarsest, px.
constexpr double kCoarsest = 64;
/// Sectors of the ball, each with its own patches; fewer where a patch is many pixels to read.
constexpr int kTrackedSectors = 16, kFewTrackedSectors = 8;
/// Patches that make a reference.
constexpr std::size_t kFewestPatches = 16;
/// Agreement needed for a motion to be accepted, and after a search of the whole picture.
constexpr double kShare = 0.3, kShareFound = 0.4;
constexpr double kFewestAgreeing = 8;
constexpr int kFewestOctants = 4;
/// The same for the surroundings.
constexpr double kFewestAround = 4;
/// One of so many patches is glanced at; the sectors are no multiple of it, so that those lie all
/// around.
constexpr std::size_t kGlancedOfPatches = 5;
constexpr std::size_t kFewestGlanced = 4;

bool is_trusted(const Consensus& ball, double share) {
  return ball.share() >= share && ball.agreeing >= kFewestAgreeing &&
         ball.octants >= kFewestOctants;
}

/// The fault seen at the ball's place alone: kDark is little contrast, which a plain wall has, too.
std::string_view fault_of(const Sighting& sighting) {
  if (sighting.expected < kFewestAgreeing) return fault::kOutside;
  if (2 * sighting.saturated > sighting.expected) return fault::kOverexposed;
  if (2 * (sighting.flat + sighting.saturated) > sighting.expected) return fault::kDark;
  return fault::kElsewhere;
}

}  // namespace

int BallTracker::scale_for(const Outline& outline) {
  const int scale = static_cast<int>(std::ceil(mean_radius(outline) / kFinest));
  return scale <= 1 ? 1 : scale + scale % 2;
}

BallTracker::BallTracker(const cv::Mat& reference, const Outline& outline, float saturated)
    : scale_(scale_for(outline)), reader_(scale_) {
  const int sectors = scale_ > 2 ? kFewTrackedSectors : kTrackedSectors;
  cv::Mat picture = reference;
  Outline here = reduced(outline, scale_);
  scales_.push_back(reference_scale(picture, here, saturated, sectors));
  while (mean_radius(here) > kCoarsest) {
    picture = halved(picture);
    here = reduced(here, 2);
    scales_.push_back(reference_scale(picture, here, saturated, sectors));
  }
  search_.emplace_back(picture, here);
  const PatchGroup& ball = scales_.front().ball;
  for (std::size_t n = 0; n < ball.size(); n += kGlancedOfPatches) glanced_.push_back(ball[n]);
}

bool BallTracker::has_texture() const {
  const PatchGroup& ball = scales_.front().ball;
  if (ball.size() < kFewestPatches) return false;
  std::array<bool, 4> quarters{};
  for (const PlacedPatch& patch : ball) {
    quarters[(patch.arm.u > 0 ? 1U : 0U) + (patch.arm.v > 0 ? 2U : 0U)] = true;
  }
  return std::ranges::count(quarters, true) >= 3;  // the picture may cut a part
}

ReadWindow BallTracker::reading(const Picture& picture) {
  return [this, &picture](cv::Point corner, PatchWindow& window) {
    return reader_.read(picture, corner, window);
  };
}

Consensus BallTracker::at(const Picture& picture, const PictureMotion& guess) {
  const ReferenceScale& finest = scales_.front();
  find_patches(finest.ball, guess, reading(picture), sighting_);
  return consensus(sighting_, std::array{guess}, mean_radius(finest.outline));
}

std::optional<PictureMotion> BallTracker::find(const Picture& picture) {
  reason_ = {};
  until_search_ = std::max(0, until_search_ - 1);
  const Consensus here = at(picture, last_);
  if (is_trusted(here, kShare)) return continued(here.motion);
  const std::string_view reason = fault_of(sighting_);
  if (until_search_ == 0) {
    // The ball's place may be without contrast because the ball is not there any more.
    if (const auto found = search(picture)) return continued(*found);
    until_search_ = kSearchEvery;
  }
  reason_ = reason == fault::kDark && !was_dark_ ? fault::kElsewhere : reason;
  return std::nullopt;
}

PictureMotion BallTracker::continued(const PictureMotion& motion) {
  until_search_ = 0;
  last_ = motion;
  return magnified(last_, scale_);
}

std::optional<double> BallTracker::distance_from(const Picture& picture,
                                                 const PictureMotion& motion) {
  const PictureMotion here = magnified(motion, 1.0 / scale_);
  find_patches(glanced_, here, reading(picture), sighting_);
  const std::size_t found = sighting_.found.size();
  if (found < kFewestGlanced || 2 * found < glanced_.size()) return std::nullopt;
  distances_.clear();
  for (const auto& [arm, shift] : sighting_.found) {
    const Vec2 way = here.at(arm);
    distances_.push_back(std::hypot(shift.shift.u - way.u, shift.shift.v - way.v));
  }
  const auto middle = distances_.begin() + static_cast<std::ptrdiff_t>(found / 2);
  std::ranges::nth_element(distances_, middle);
  return scale_ * *middle;
}

std::optional<PictureMotion> BallTracker::search(const Picture& picture) {
  if (const Consensus back = at(picture, {}); is_trusted(back, kShareFound)) return back.motion;
  std::vector<cv::Mat> pyramid{smoothed_luminance(picture, scale_)};
  was_dark_ = is_too_dark(cv::mean(pyramid.front())[0], picture.format);
  while (pyramid.size() < scales_.size()) pyramid.push_back(halved(pyramid.back()));
  const Consensus found = at(picture, coarse_motion(pyramid, saturation(picture.format)));
  return is_trusted(found, kShareFound) ? std::optional(found.motion) : std::nullopt;
}

PictureMotion BallTracker::coarse_motion(const std::vector<cv::Mat>& pyramid, float saturated) {
  const auto agreed = [&](std::size_t level, const PictureMotion& guess) {
    const auto read = [&](cv::Point corner, PatchWindow& window) {
      return read_window(pyramid[level], corner, saturated, window);
    };
    find_patches(scales_[level].ball, guess, read, sighting_);
    return consensus(sighting_, std::array{guess}, mean_radius(scales_[level].outline));
  };
  const std::size_t coarsest = scales_.size() - 1;
  Consensus best;
  for (const Vec2& shift : search_.front().run(pyramid.back())) {
    const Consensus other = agreed(coarsest, {shift.u, shift.v, 0, 0});
    if (other.agreeing > best.agreeing) best = other;
  }
  for (std::size_t level = coarsest; level-- > 1;) {
    best = agreed(level, magnified(best.motion, 2));
  }
  return coarsest > 0 ? magnified(best.motion, 2) : best.motion;
}

std::optional<double> BallTracker::share_of_surroundings(const Picture& picture,
                                                         const PictureMotion& ball) {
  const ReferenceScale& finest = scales_.front();
  const PictureMotion here = magnified(ball, 1.0 / scale_);
  Consensus best;
  for (const PictureMotion& guess : {PictureMotion{}, here}) {
    find_patches(finest.surroundings, guess, reading(picture), sighting_);
    const Consensus other = consensus(sighting_, std::array{guess}, mean_radius(finest.outline));
    if (other.agreeing > best.agreeing) best = other;
  }
  if (best.agreeing < kFewestAround || best.share() < kShare) return std::nullopt;
  double along = 0, square = 0;
  for (const PlacedPatch& patch : finest.surroundings) {
    const Vec2 with_ball = here.at(patch.arm), own = best.motion.at(patch.arm);
    along += with_ball.u * own.u + with_ball.v * own.v;
    square += with_ball.u * with_ball.u + with_ball.v * with_ball.v;
  }
  return square > 0 ? std::optional(along / square) : std::nullopt;
}

}  // namespace orbwatch::align
