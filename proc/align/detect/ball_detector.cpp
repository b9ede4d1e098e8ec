#include "proc/align/detect/ball_detector.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "proc/align/detect/centre_votes.h"
#include "proc/align/detect/certainty.h"
#include "proc/align/detect/circle_search.h"
#include "proc/align/detect/limb_fit.h"
#include "proc/align/detect/limb_likelihood.h"
#include "proc/align/detect/limb_score.h"
#include "proc/align/detect/luminance.h"
#include "proc/align/detect/pyramid.h"

namespace orbwatch::align {
namespace {

using optics::Outline;

constexpr int kSmallestSide = 64;
/// Scales that are searched; the coarsest for balls of any size, the others for small ones.
constexpr std::size_t kScales = 3;
constexpr double kNearest = 18, kNearestCoarse = 12, kFarthest = 80;  // radii, px
constexpr double kLargest = 0.62;  // radius, of the picture's short side
/// A difference() from which on two outlines are different places.
constexpr double kElsewhere = 0.5;
constexpr std::size_t kVotes = 8, kClimbed = 6, kFitted = 4, kRefined = 3;
/// px: the radius at which a limb is judged.
constexpr double kJudged = 90;
/// px: that of the last fit, and what it sees on both sides.
constexpr double kFine = 400, kAround = 8;
/// px: a blurred edge looks like the ball's inside until there.
constexpr double kBlur = 1;

/// A limb and what speaks for it.
struct Candidate {
  Outline outline;  ///< the picture's pixels
  LimbScore score;
  double rank = 0;    ///< Circle::rank()
  double radius = 0;  ///< px, at the scale at which it was judged

  /// By which candidates of one picture are compared: the logarithm of the odds that the outline is
  /// a ball's and right to 3 %, a logistic regression over 6000 in 420 simulated rooms.
  double odds() const {
    return 16 * score.drop + 11.5 * score.contour + 107 * rank +
           3.1 * std::log(std::min(radius, kJudged) / 60) - 15.7;
  }
};

/// Another place whose odds are less than that lower makes the best one doubtful.
constexpr double kRivalOdds = 2;

double mean_radius(const Outline& outline) { return (outline.rx + outline.ry) / 2; }

/// The larger of the differences of centres and radii, as a share of the smaller radius.
double difference(const Outline& a, const Outline& b) {
  const double apart = std::hypot(a.centre.u - b.centre.u, a.centre.v - b.centre.v);
  return std::max(apart, std::abs(a.rx - b.rx)) / std::min(a.rx, b.rx);
}

/// One picture under search.
class Search {
 public:
  explicit Search(const cv::Mat& luminance) : pyramid_(luminance), slopes_(pyramid_.size()) {}

  /// The best limbs, the best first.
  std::vector<Candidate> run() {
    std::vector<Candidate> candidates;
    for (const Outline& circle : circles()) {
      for (const Outline& start :
           {closer(circle, Rings::All), closer(circle, Rings::Outer), fitted(circle, 45, 7)}) {
        const Outline limb = fitted(fitted(start, kJudged, 6), kJudged, 4);
        if (const auto candidate = judged(limb)) candidates.push_back(*candidate);
      }
    }
    keep_best(candidates);
    for (Candidate& candidate : candidates) {
      const Outline limb = fitted(fitted(candidate.outline, 2 * kJudged, 6), kFine, kAround);
      candidate = judged(limb).value_or(candidate);
    }
    keep_best(candidates);
    return candidates;
  }

  LimbEvidence evidence(const Candidate& best) const {
    const std::size_t level = pyramid_.level_for(best.outline, kJudged);
    const Outline here = Pyramid::between(best.outline, 0, level);
    return {best.rank,
            best.radius,
            near_drop(pyramid_.level(level), here),
            best.score.contour,
            likelihood(best.outline),
            shift(best.outline, level)};
  }

 private:
  /// LimbEvidence::likelihood
  double likelihood(const Outline& outline) const {
    const std::size_t level = pyramid_.level_for(outline, kFine);
    const Outline here = Pyramid::between(outline, 0, level);
    const cv::Mat& luminance = pyramid_.level(level);
    return LimbLikelihood(LimbStrip(luminance, here, kAround), here, luminance.size())
        .above_random({});
  }

  /// LimbEvidence::shift
  double shift(const Outline& outline, std::size_t level) const {
    const double right = std::max(0.02 * mean_radius(outline), 3.0);
    const double reach = std::max(5.0, 3 * std::ldexp(right, -static_cast<int>(level)));
    const Outline here = Pyramid::between(outline, 0, level);
    const Outline there = Pyramid::between(fit_limb(pyramid_.level(level), here, reach), level, 0);
    const double apart =
        std::hypot(there.centre.u - outline.centre.u, there.centre.v - outline.centre.v);
    const double wider = std::abs(mean_radius(there) - mean_radius(outline));
    return std::max(apart, wider) / right;
  }

  struct Found {
    std::size_t level;
    Circle circle;
  };

  const Slopes& slopes(std::size_t level) {
    if (slopes_[level].along_u.empty()) slopes_[level] = slopes_of(pyramid_.level(level));
    return slopes_[level];
  }

  /// Circles that may be limbs, at the scale at which they were found; the best first.
  std::vector<Found> found() {
    std::vector<Found> all;
    const std::size_t coarsest = pyramid_.size() - 1;
    for (std::size_t i = 0; i < std::min(kScales, pyramid_.size()); ++i) {
      const std::size_t level = coarsest - i;
      const double largest = kLargest * std::min(slopes(level).width(), slopes(level).height());
      const double nearest = i == 0 ? kNearestCoarse : kNearest;
      const double farthest = i == 0 ? largest : std::min(kFarthest, largest);
      if (farthest < nearest) continue;
      const double limit = i == 0 ? largest : std::min(1.2 * kFarthest, largest);
      for (const auto& centre : centre_votes(slopes(level), nearest, farthest, kVotes)) {
        all.push_back(
            {level, best_circle(slopes(level), law_, Rings::All, centre, nearest, limit)});
      }
    }
    const auto better = [](const Found& a, const Found& b) {
      return a.circle.rank() > b.circle.rank();
    };
    std::ranges::sort(all, better);
    if (all.size() > kClimbed) all.resize(kClimbed);
    for (Found& f : all) f.circle = climb(slopes(f.level), law_, Rings::All, f.circle, 0.1);
    std::ranges::sort(all, better);
    return all;
  }

  /// The best of them that differ, in the picture's pixels.
  std::vector<Outline> circles() {
    std::vector<Outline> kept;
    for (const Found& f : found()) {
      if (kept.size() == kFitted) break;
      const Outline outline = without_blur(f.circle, f.level);
      if (std::ranges::none_of(
              kept, [&](const Outline& other) { return difference(outline, other) < 0.05; })) {
        kept.push_back(outline);
      }
    }
    return kept;
  }

  static Outline without_blur(const Circle& circle, std::size_t level) {
    const double radius = circle.radius - kBlur;
    return Pyramid::between({circle.centre, radius, radius, 0}, level, 0);
  }

  /// The circle at finer scales.
  Outline closer(Outline outline, Rings rings) {
    double step = 0.05;
    std::optional<std::size_t> last;
    for (const double radius : {kJudged / 2, kJudged}) {
      const std::size_t level = pyramid_.level_for(outline, radius);
      if (level == last) continue;
      last = level;
      const Outline here = Pyramid::between(outline, 0, level);
      outline = without_blur(
          climb(slopes(level), law_, rings, {here.centre, mean_radius(here)}, step), level);
      step /= 2;
    }
    return outline;
  }

  /// The most likely limb around, by the scale at which it has about that radius.
  Outline fitted(const Outline& outline, double radius, double reach) const {
    const std::size_t level = pyramid_.level_for(outline, radius);
    return Pyramid::between(
        fit_limb(pyramid_.level(level), Pyramid::between(outline, 0, level), reach), level, 0);
  }

  std::optional<Candidate> judged(const Outline& outline) {
    const std::size_t level = pyramid_.level_for(outline, kJudged);
    const Outline here = Pyramid::between(outline, 0, level);
    const double radius = mean_radius(here);
    if (std::min(here.rx, here.ry) < kNearestCoarse) return std::nullopt;
    const Circle circle = best_circle(slopes(level), law_, Rings::All, here.centre, 0.99 * radius,
                                      1.02 * radius + kBlur);
    return Candidate{outline, limb_score(pyramid_.level(level), here), circle.rank(), radius};
  }

  /// The best kRefined and the best one elsewhere, the best first.
  static void keep_best(std::vector<Candidate>& candidates) {
    std::ranges::sort(candidates, std::greater<>(), &Candidate::odds);
    std::vector<Candidate> kept;
    for (const Candidate& candidate : candidates) {
      const bool is_elsewhere = std::ranges::all_of(kept, [&](const Candidate& other) {
        return difference(candidate.outline, other.outline) > kElsewhere;
      });
      if (kept.size() < kRefined || is_elsewhere) kept.push_back(candidate);
      if (kept.size() > kRefined) break;
    }
    candidates = kept;
  }

  Pyramid pyramid_;
  std::vector<Slopes> slopes_;  ///< of the pyramid's levels, made when needed
  ReflectionLaw law_;
};

/// Whether another place looks nearly as much like a ball.
bool has_rival(const std::vector<Candidate>& candidates) {
  return std::ranges::any_of(candidates, [&](const Candidate& other) {
    return other.odds() > candidates.front().odds() - kRivalOdds &&
           difference(other.outline, candidates.front().outline) > kElsewhere;
  });
}

/// What speaks against the best candidate, for an operator.
std::string doubt(const Candidate& best, const LimbEvidence& evidence, bool rival) {
  if (rival) return "two places look nearly alike; hide what is no ball, or cut the picture";
  if (evidence.radius < kLeastRadius) return "it is small; a ball needs a larger picture";
  if (best.score.drop < 0.25) return "what is inside is hardly compressed towards the limb";
  if (evidence.likelihood < kLeastLikelihood) return "it does not end as a ball does: a dome?";
  if (best.score.contour < 0.6) return "its limb is no clear edge: blurred, or much is hidden";
  return "too little of the picture tells whether it is a ball";
}

}  // namespace

Result<BallDetection> detect_ball(const Picture& picture) {
  if (std::min(picture.width, picture.height) < kSmallestSide) {
    return fail("the picture is " + std::to_string(picture.width) + "x" +
                std::to_string(picture.height) + "; a ball is found in at least " +
                std::to_string(kSmallestSide) + "x" + std::to_string(kSmallestSide) + " pixels");
  }
  Search search(luminance_of(picture));
  const std::vector<Candidate> limbs = search.run();
  if (limbs.empty()) return fail("the picture shows no edges that could be a ball's");
  const Candidate& best = limbs.front();
  const bool rival = has_rival(limbs);
  const LimbEvidence evidence = search.evidence(best);
  const double odds = certainty(evidence) - kCertain;
  BallDetection ball{best.outline, 1 / (1 + std::exp(-(rival ? std::min(odds, -0.1) : odds))), ""};
  if (!ball.is_confident()) ball.reason = doubt(best, evidence, rival);
  return ball;
}

}  // namespace orbwatch::align
