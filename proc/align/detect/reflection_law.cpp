#include "proc/align/detect/reflection_law.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::align {
namespace {

/// Share of slopes on a ball that have nothing to do with the room (dust, noise, a mount) or belong
/// to lines of the room that stay lines along the radius.
constexpr double kStray = 0.35;

/// The steepest compression that pixels still show.
constexpr double kMost = 10;

/// The logarithm of the likelihoods' ratio for one compression.
double log_ratio(double k, double share) {
  return std::log(kStray + (1 - kStray) * k / (share + k * k * (1 - share)));
}

}  // namespace

ReflectionLaw::ReflectionLaw() {
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    const double rho = (kBounds[ring] + kBounds[ring + 1]) / 2;
    const double k = std::min(1 / (1 - rho * rho), kMost);
    for (std::size_t step = 0; step < kSteps; ++step) {
      table_[step][ring] =
          static_cast<float>(log_ratio(k, (static_cast<double>(step) + 0.5) / kSteps));
    }
  }
}

}  // namespace orbwatch::align
