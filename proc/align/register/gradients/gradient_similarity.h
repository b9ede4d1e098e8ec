// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/register/gradients/gradient_field.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Agreement of two cameras' edges when the second one's world is turned. Reentrant.
class GradientSimilarity {
 public:
  /// `samples` of the reference camera's field, `field` of the other one, which outlives this.
  GradientSimilarity(std::vector<GradientField::Sample> samples, const GradientField& field)
      : samples_(std::move(samples)), field_(field) {}

  /// Similarity, 0 to 1: the mean of cos^2 between gradients, times their lengths, over the part
  /// that both show. `turn`: radians about the reference frame's axes.
  double at(const optics::Vec3& turn) const;

  /// Number of samples that agree within about 30 degrees.
  int agreeing(const optics::Vec3& turn) const;

 private:
  template <class Visit>
  void visit(const optics::Vec3& turn, const Visit& each) const;

  std::vector<GradientField::Sample> samples_;
  const GradientField& field_;
};

/// The top of a smooth function of a turn, and its second derivatives there.
struct Summit {
  optics::Vec3 turn;
  double value = 0;
  optics::Mat3 curvature;  ///< per rad^2; negative definite at a summit
};

/// Climbs from `start` by parabolas through points `step` radians away, which end up `least` away.
Summit climb(const GradientSimilarity& similarity, const optics::Vec3& start, double step,
             double least);

}  // namespace orbwatch::align
