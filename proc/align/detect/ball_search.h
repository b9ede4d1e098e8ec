// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/detect/certainty.h"
#include "proc/align/detect/picture/pyramid.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// A limb found, in the picture's pixels, and the evidence for it.
struct FoundLimb {
  optics::Outline outline;
  LimbEvidence evidence;
};

/// The larger of the differences of centres and radii, as a share of the smaller radius.
double difference(const optics::Outline& a, const optics::Outline& b);

/// Looks for limbs of balls in one picture, from coarse to fine. Immutable; reentrant.
class BallSearch {
 public:
  /// `luminance`: one channel, 8 or 16 bit.
  explicit BallSearch(const cv::Mat& luminance) : pyramid_(luminance) {}

  /// Limbs at different places, the most certain first; only that one is fitted at the finest
  /// scale.
  std::vector<FoundLimb> run() const;

 private:
  /// A circle or an ellipse and its likeness to a limb, in the picture's pixels.
  struct Likely {
    optics::Outline outline;
    double likeness = 0;  ///< LimbColumns::above_random(), the mean of all parts
  };

  std::vector<Likely> rings() const;
  std::vector<Likely> limbs() const;
  static std::vector<Likely> best_of(std::vector<Likely> all, std::size_t most, double apart);
  Likely fitted(const optics::Outline& outline, double radius) const;
  FoundLimb with_evidence(const Likely& limb) const;
  double likeness(const optics::Outline& outline, double radius) const;

  Pyramid pyramid_;
};

}  // namespace orbwatch::align
