#include "proc/align/detect/ball_search.h"

#include <algorithm>
#include <cmath>

#include "proc/align/detect/centre_votes.h"
#include "proc/align/detect/limb_fit.h"
#include "proc/align/detect/limb_likelihood.h"
#include "proc/align/detect/limb_score.h"

namespace orbwatch::align {
namespace {

using optics::Outline;

/// Scales that are searched; the coarsest for balls of any size, the others for small ones.
constexpr std::size_t kScales = 3;
constexpr double kNearest = 18, kNearestCoarse = 12, kFarthest = 80;  // radii, px
constexpr double kLargest = 0.62;  // radius, of the picture's short side
/// How many places are voted for at each scale, and how many circles are climbed and fitted.
constexpr std::size_t kVotes = 8, kClimbed = 8, kFitted = 6;
/// A difference() from which on two circles are worth a fit each.
constexpr double kApart = 0.05;
/// px: radii at which limbs are fitted, one after the other; at the second they are compared.
constexpr double kCoarse = 45, kCompared = 90, kFine = 400;
/// px: what is seen on both sides of a limb.
constexpr double kAround = 8;
/// px: a blurred edge looks like the ball's inside until there.
constexpr double kBlur = 1;

double mean_radius(const Outline& outline) { return (outline.rx + outline.ry) / 2; }

}  // namespace

double difference(const Outline& a, const Outline& b) {
  const double apart = std::hypot(a.centre.u - b.centre.u, a.centre.v - b.centre.v);
  return std::max(apart, std::abs(a.rx - b.rx)) / std::min(a.rx, b.rx);
}

BallSearch::BallSearch(const cv::Mat& luminance) : pyramid_(luminance), slopes_(pyramid_.size()) {}

std::vector<FoundLimb> BallSearch::run() {
  std::vector<FoundLimb> limbs;
  for (const Outline& circle : circles()) {
    const Outline limb = fitted(fitted(circle, kCoarse), kCompared);
    if (mean_radius(limb) >= kNearestCoarse) limbs.push_back({limb, likeness(limb, kCompared)});
  }
  std::ranges::sort(limbs, std::greater<>(), &FoundLimb::likeness);
  if (!limbs.empty()) limbs[0].outline = fitted(limbs[0].outline, kFine);
  return limbs;
}

LimbEvidence BallSearch::evidence(const FoundLimb& limb) const {
  const std::size_t level = pyramid_.level_for(limb.outline, kCompared);
  const cv::Mat& luminance = pyramid_.level(level);
  const Outline here = Pyramid::between(limb.outline, 0, level);
  return {mean_radius(here), near_drop(luminance, here), contour(luminance, here),
          likeness(limb.outline, kFine)};
}

const Slopes& BallSearch::slopes(std::size_t level) {
  if (slopes_[level].along_u.empty()) slopes_[level] = slopes_of(pyramid_.level(level));
  return slopes_[level];
}

/// The best circles around the places that slopes point to.
std::vector<BallSearch::Start> BallSearch::starts(std::size_t level, bool coarsest) {
  const Slopes& here = slopes(level);
  const double largest = kLargest * std::min(here.width(), here.height());
  const double nearest = coarsest ? kNearestCoarse : kNearest;
  const double farthest = coarsest ? largest : std::min(kFarthest, largest);
  if (farthest < nearest) return {};
  const double limit = coarsest ? largest : std::min(1.2 * kFarthest, largest);
  std::vector<Start> starts;
  for (const auto& centre : centre_votes(here, nearest, farthest, kVotes)) {
    starts.push_back({level, best_circle(here, law_, centre, nearest, limit)});
  }
  return starts;
}

/// Of all scales, the best first.
std::vector<BallSearch::Start> BallSearch::starts() {
  std::vector<Start> all;
  for (std::size_t n = 0; n < std::min(kScales, pyramid_.size()); ++n) {
    const std::vector<Start> more = starts(pyramid_.size() - 1 - n, n == 0);
    all.insert(all.end(), more.begin(), more.end());
  }
  const auto rank = [](const Start& start) { return start.circle.rank(); };
  std::ranges::sort(all, std::greater<>(), rank);
  if (all.size() > kClimbed) all.resize(kClimbed);
  for (Start& start : all) start.circle = climb(slopes(start.level), law_, start.circle, 0.1);
  std::ranges::sort(all, std::greater<>(), rank);
  return all;
}

/// Those that differ, in the picture's pixels.
std::vector<Outline> BallSearch::circles() {
  std::vector<Outline> kept;
  for (const Start& start : starts()) {
    if (kept.size() == kFitted) break;
    const double radius = start.circle.radius - kBlur;
    const Outline outline =
        Pyramid::between({start.circle.centre, radius, radius, 0}, start.level, 0);
    if (std::ranges::all_of(
            kept, [&](const Outline& other) { return difference(outline, other) >= kApart; })) {
      kept.push_back(outline);
    }
  }
  return kept;
}

/// The most likely limb around, by the scale at which it has about that radius.
Outline BallSearch::fitted(const Outline& outline, double radius) const {
  const std::size_t level = pyramid_.level_for(outline, radius);
  return Pyramid::between(
      fit_limb(pyramid_.level(level), Pyramid::between(outline, 0, level), kAround), level, 0);
}

double BallSearch::likeness(const Outline& outline, double radius) const {
  const std::size_t level = pyramid_.level_for(outline, radius);
  const cv::Mat& luminance = pyramid_.level(level);
  const Outline here = Pyramid::between(outline, 0, level);
  return LimbLikelihood(LimbStrip(luminance, here, kAround), here, luminance.size()).above_random();
}

}  // namespace orbwatch::align
