// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/register/gradients/gradient_field.h"
#include "proc/align/register/place_change.h"

namespace orbwatch::align {

/// Similarity of two cameras' edges, as GradientSimilarity defines it, when the second one's place
/// changes by fractions of a degree; edges count by that camera's resolution, which limits how well
/// it shows their places. Reentrant.
class PlaceAgreement {
 public:
  /// `samples` of the reference camera's field; `field` of the other one at the place of `shifts`,
  /// which outlives this.
  PlaceAgreement(const std::vector<GradientField::Sample>& samples, const PlaceShifts& shifts,
                 const GradientField& field);

  double at(const PlaceChange& change) const;

  /// The derivative of at() and its covariance. Neighbouring samples deviate together, so that it
  /// follows from how far the parts of the sphere contradict each other.
  struct Slope {
    PlaceChange sum;
    PlaceCovariance covariance;
  };
  Slope slope(const PlaceChange& change, double step) const;

  /// Normal matrix of the edges' offsets across themselves, weighted by their agreement, in units
  /// in which the derivatives of at() about the turn have its trace. Positive semidefinite, unlike
  /// the second derivatives of at(), which noise makes indefinite where edges determine little.
  /// Error: a place at which the edges agree the least.
  Result<PlaceCovariance> normal_matrix(double step) const;

 private:
  struct Edge {
    GradientField::Sample sample;
    PlaceShifts::Shifts shifts;
    double weight;
  };

  /// Calls each(edge, weighted similarity) and returns the sum of weights.
  template <class Visit>
  double visit(const PlaceChange& change, const Visit& each) const;
  std::array<double, GradientField::kParts> parts(const PlaceChange& change) const;

  std::vector<Edge> edges_;
  const GradientField& field_;
};

}  // namespace orbwatch::align
