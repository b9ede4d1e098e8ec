#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/detect/certainty.h"
#include "proc/align/detect/circle_search.h"
#include "proc/align/detect/pyramid.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// A limb that was found, the picture's pixels.
struct FoundLimb {
  optics::Outline outline;
  double likeness = 0;  ///< LimbLikelihood::above_random()
};

/// The larger of the differences of centres and radii, as a share of the smaller radius.
double difference(const optics::Outline& a, const optics::Outline& b);

/// Looks for limbs of balls in one picture, from coarse to fine.
class BallSearch {
 public:
  /// `luminance`: one channel, 8 or 16 bit.
  explicit BallSearch(const cv::Mat& luminance);

  /// Limbs at different places, the most like a ball's first; only that one to the last detail.
  std::vector<FoundLimb> run();

  /// What speaks for a limb of run().
  LimbEvidence evidence(const FoundLimb& limb) const;

 private:
  /// A circle that may be a limb, and the scale at which it was found.
  struct Start {
    std::size_t level;
    Circle circle;
  };

  const Slopes& slopes(std::size_t level);
  std::vector<Start> starts();
  std::vector<Start> starts(std::size_t level, bool coarsest);
  std::vector<optics::Outline> circles();
  optics::Outline fitted(const optics::Outline& outline, double radius) const;
  double likeness(const optics::Outline& outline, double radius) const;

  Pyramid pyramid_;
  std::vector<Slopes> slopes_;  ///< of the pyramid's levels, made when needed
  ReflectionLaw law_;
};

}  // namespace orbwatch::align
