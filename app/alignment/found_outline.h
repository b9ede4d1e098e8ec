// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "proc/align/detect/ball_detector.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Standard deviation of a found outline's centre and radius, as a share of the radius.
inline constexpr double kFoundOutlineSigma = 0.02;

/// Ball of a picture that shows it for sure, else of the picture in which it is surest. `pictures`:
/// at least one. Reentrant. Error: that of align::detect_ball(), if no picture shows a ball.
Result<align::BallDetection> surest_ball(std::span<const Picture> pictures);

/// "the ball is not found for sure: REASON": about a detection that is not confident. Reentrant.
std::string doubt_text(const align::BallDetection& ball);

/// The ball in a picture, found for sure. Reentrant. Error: that of align::detect_ball(); a ball
/// that is not found for sure: the doubt, and how its outline is stated instead.
Result<align::BallDetection> found_outline(const Picture& picture);

}  // namespace orbwatch::app
