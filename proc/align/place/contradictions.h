#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "proc/align/place/adjustment.h"

namespace orbwatch::align {

/// The mark that the rest contradicts most, if any.
struct Contradiction {
  std::size_t used = 0;  ///< index into Adjustment::used()
  /// Another that may be wrong as well instead: leaving it out would help almost as much.
  std::optional<std::size_t> rival;
};

/// Tests each mark against the solution of all: by how much the sum of squares would fall without
/// it, which is chi-square with 2 degrees of freedom for a good mark (Baarda's data snooping, for
/// pairs of equations). `covariance`: of the equations' columns. nullopt: none is off. Marks that
/// alone determine an unknown cannot be tested.
std::optional<Contradiction> contradiction(const Equations& equations, const cv::Mat1d& covariance,
                                           std::size_t marks);

/// The value that chi-square with that many degrees of freedom exceeds once in 10000 times; Wilson
/// and Hilferty's approximation.
double chi_square_limit(int degrees_of_freedom);

}  // namespace orbwatch::align
