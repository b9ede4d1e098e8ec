// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/found_outline.h"

#include "app/alignment/figure_text.h"

namespace orbwatch::app {

Result<align::BallDetection> surest_ball(std::span<const Picture> pictures) {
  auto best = align::detect_ball(pictures.front());
  for (const Picture& picture : pictures.subspan(1)) {
    if (best && best->is_confident()) break;
    const auto other = align::detect_ball(picture);
    if (other && (!best || other->confidence > best->confidence)) best = other;
  }
  return best;
}

std::string doubt_text(const align::BallDetection& ball) {
  return "the ball is not found for sure: " + ball.reason;
}

Result<align::BallDetection> found_outline(const Picture& picture) {
  auto ball = align::detect_ball(picture);
  if (!ball || ball->is_confident()) return ball;
  return fail(doubt_text(*ball) + " (" + figure_text("confidence", ball->confidence) +
              "); look at it by `orbwatch detect --overlay`, and state its outline");
}

}  // namespace orbwatch::app
