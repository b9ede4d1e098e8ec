// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "proc/align/place/adjustment.h"

namespace orbwatch::align {

/// The mark that contradicts the others most, if any.
struct Contradiction {
  std::size_t used = 0;  ///< index into Adjustment::used()
  /// Another mark that may be the wrong one instead: leaving it out would help almost as much.
  std::optional<std::size_t> rival;
};

/// Tests each mark against the solution of all: the decrease of the sum of squares without it is
/// chi-square with 2 degrees of freedom for a good mark (Baarda's data snooping, for pairs of
/// equations). `covariance`: that of the equations' columns. nullopt: none is off. Marks that alone
/// determine an unknown cannot be tested.
std::optional<Contradiction> contradiction(const Equations& equations, const cv::Mat1d& covariance,
                                           std::size_t marks);

/// The value that chi-square with that many degrees of freedom exceeds once in 10000 times; Wilson
/// and Hilferty's approximation.
double chi_square_limit(int degrees_of_freedom);

}  // namespace orbwatch::align
