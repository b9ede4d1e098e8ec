// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/ball_detector.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "proc/align/detect/ball_search.h"
#include "proc/align/detect/certainty.h"
#include "proc/align/detect/defocus.h"
#include "proc/align/detect/picture/luminance.h"

namespace orbwatch::align {
namespace {

constexpr int kSmallestSide = 64;
/// A difference() from which on two limbs are different places. A second one less certain by at
/// most kRival makes the best one doubtful.
constexpr double kElsewhere = 0.5, kRival = 2.6;
/// Confidence in a ball whose outline may be too large.
constexpr double kDoubtful = 0.4;

/// True when `inner` lies within `outer`, up to a twentieth of its radius.
bool is_within(const optics::Outline& inner, const optics::Outline& outer) {
  const double apart = std::hypot(inner.centre.u - outer.centre.u, inner.centre.v - outer.centre.v);
  return apart + optics::mean_radius(inner) < 1.05 * optics::mean_radius(outer);
}

/// True when another place looks nearly as much like a ball, unless the best limb's ball shows it.
bool has_rival(const std::vector<FoundLimb>& limbs) {
  const FoundLimb& best = limbs.front();
  return std::ranges::any_of(limbs, [&](const FoundLimb& other) {
    return certainty(other.evidence) > certainty(best.evidence) - kRival &&
           difference(other.outline, best.outline) > kElsewhere &&
           !is_within(other.outline, best.outline);
  });
}

/// Reason to doubt the best limb, for an operator.
std::string doubt(const LimbEvidence& evidence, bool rival) {
  if (rival) return "two places look nearly alike; hide what is not the ball, or cut the picture";
  if (evidence.radius < kLeastRadius) return "it is small; a ball needs a larger picture";
  if (evidence.near_drop < 0.25) return "what is inside is hardly compressed towards the limb";
  if (evidence.likelihood < kLeastLikelihood) return "it does not end as a ball does: a dome?";
  if (evidence.contour < 0.6)
    return "its limb does not have a clear edge: blurred, or much is hidden";
  return "too little of the picture tells whether it is a ball";
}

}  // namespace

Result<BallDetection> detect_ball(const Picture& picture) {
  if (std::min(picture.width, picture.height) < kSmallestSide) {
    return fail("the picture is " + std::to_string(picture.width) + "x" +
                std::to_string(picture.height) + "; a ball is found in at least " +
                std::to_string(kSmallestSide) + "x" + std::to_string(kSmallestSide) + " pixels");
  }
  const std::vector<FoundLimb> limbs = BallSearch(luminance_of(picture)).run();
  if (limbs.empty()) return fail("the picture shows no edges that could be a ball's");
  const FoundLimb& best = limbs.front();
  const bool rival = has_rival(limbs);
  const double odds = certainty(best.evidence) - kCertain;
  BallDetection ball{best.outline, 1 / (1 + std::exp(-(rival ? std::min(odds, -0.1) : odds))), ""};
  if (!ball.is_confident()) {
    ball.reason = doubt(best.evidence, rival);
  } else if (is_out_of_focus(picture, best.outline)) {
    ball.confidence = kDoubtful;
    ball.reason = "it is out of focus, so that its outline may be too large; focus on the ball";
  }
  return ball;
}

}  // namespace orbwatch::align
