// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/ball_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "proc/align/detect/centre_votes.h"
#include "proc/align/detect/limb/limb_fit.h"
#include "proc/align/detect/limb/limb_likelihood.h"
#include "proc/align/detect/limb/limb_score.h"
#include "proc/align/detect/picture/slopes.h"
#include "proc/align/detect/ring/ring_search.h"
#include "proc/align/detect/ring/ring_strip.h"

namespace orbwatch::align {
namespace {

using optics::Outline;

/// Scales that are searched, from the coarsest on; each covers balls of similar size there.
constexpr std::size_t kScales = 5;
constexpr double kLargest = 0.62;  // radius, relative to the picture's short side
/// Places voted for at each scale.
constexpr std::size_t kVotes = 8;
/// Rings around each place: the reflection has rings too, which may be likelier than the limb until
/// both are fitted.
constexpr std::size_t kRingsOfAPlace = 3;
/// Radii at which limbs are compared, and at which the best one is fitted in the end, px.
constexpr double kCompared = 90, kFine = 400;
/// Width of the strip on both sides of a limb, px.
constexpr double kAround = 8;
/// Smallest limb that has surroundings, px.
constexpr double kSmallestRadius = 12;

/// One stage of fitting: limbs are fitted at finer and finer scales, fewer and fewer of them.
struct Stage {
  double radius;     ///< px, about that of the limb's picture
  std::size_t most;  ///< limbs that are fitted
  double apart;      ///< the difference() from which on two are worth a fit each
};
constexpr Stage kStages[]{{45, 24, 0.05}, {45, 6, 0.02}, {kCompared, 4, 0.02}};

}  // namespace

double difference(const Outline& a, const Outline& b) {
  const double apart = std::hypot(a.centre.u - b.centre.u, a.centre.v - b.centre.v);
  return std::max(apart, std::abs(a.rx - b.rx)) / std::min(a.rx, b.rx);
}

std::vector<FoundLimb> BallSearch::run() const {
  std::vector<FoundLimb> found;
  for (const Likely& limb : limbs()) found.push_back(with_evidence(limb));
  std::ranges::sort(found, std::greater<>(),
                    [](const FoundLimb& limb) { return certainty(limb.evidence); });
  if (found.empty()) return found;
  const Outline fine = fitted(found[0].outline, kFine).outline;
  found[0] = with_evidence({fine, likeness(fine, kFine)});
  return found;
}

/// Fits the most likely limbs, stage by stage.
std::vector<BallSearch::Likely> BallSearch::limbs() const {
  std::vector<Likely> all = rings();
  for (const Stage& stage : kStages) {
    all = best_of(std::move(all), stage.most, stage.apart);
    for (Likely& limb : all) limb = fitted(limb.outline, stage.radius);
  }
  std::erase_if(all,
                [](const Likely& limb) { return mean_radius(limb.outline) < kSmallestRadius; });
  return all;
}

/// The most likely limbs that differ by more than `apart`.
std::vector<BallSearch::Likely> BallSearch::best_of(std::vector<Likely> all, std::size_t most,
                                                    double apart) {
  std::ranges::sort(all, std::greater<>(), &Likely::likeness);
  std::vector<Likely> kept;
  for (const Likely& one : all) {
    if (kept.size() == most) break;
    if (std::ranges::all_of(kept, [&](const Likely& other) {
          return difference(one.outline, other.outline) >= apart;
        })) {
      kept.push_back(one);
    }
  }
  return kept;
}

FoundLimb BallSearch::with_evidence(const Likely& limb) const {
  const std::size_t level = pyramid_.level_for(limb.outline, kCompared);
  const cv::Mat& luminance = pyramid_.level(level);
  const Outline here = Pyramid::between(limb.outline, 0, level);
  return {limb.outline,
          {mean_radius(here), near_drop(luminance, here), contour(luminance, here), limb.likeness}};
}

/// Rings around the places that slopes point to, at all scales.
std::vector<BallSearch::Likely> BallSearch::rings() const {
  std::vector<Likely> all;
  for (std::size_t n = 0; n < std::min(kScales, pyramid_.size()); ++n) {
    const std::size_t level = pyramid_.size() - 1 - n;
    const cv::Mat& luminance = pyramid_.level(level);
    const double largest = kLargest * std::min(luminance.cols, luminance.rows);
    const double farthest = std::min(RingStrip::kFarthest, largest);
    if (farthest < RingStrip::kNearest) continue;
    for (const optics::Vec2 place :
         centre_votes(slopes_of(luminance), RingStrip::kNearest, farthest, kVotes)) {
      for (const Ring& ring : likeliest_rings(luminance, place, kRingsOfAPlace)) {
        const Outline circle{ring.centre, ring.radius, ring.radius, 0};
        all.push_back({Pyramid::between(circle, level, 0), ring.likeness});
      }
    }
  }
  return all;
}

/// Fits the most likely limb nearby, at the scale at which it has about that radius.
BallSearch::Likely BallSearch::fitted(const Outline& outline, double radius) const {
  const std::size_t level = pyramid_.level_for(outline, radius);
  const LimbFit fit = fit_limb(pyramid_.level(level), Pyramid::between(outline, 0, level), kAround);
  return {Pyramid::between(fit.outline, level, 0), fit.likeness};
}

double BallSearch::likeness(const Outline& outline, double radius) const {
  const std::size_t level = pyramid_.level_for(outline, radius);
  const cv::Mat& luminance = pyramid_.level(level);
  const Outline here = Pyramid::between(outline, 0, level);
  return LimbLikelihood(LimbStrip(luminance, here, kAround), here, luminance.size()).above_random();
}

}  // namespace orbwatch::align
