// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace orbwatch::app {

/// Bound, mm, of the error at the work piece that 19 of 20 alignments keep; `work_sigma`: see
/// AlignedSite. An error of a direction has two normal components, so that the factor is the root
/// of ln 20. Reentrant.
constexpr double work_bound(double work_sigma) {
  constexpr double kIn19Of20 = 1.7308;
  return kIn19Of20 * work_sigma;
}

}  // namespace orbwatch::app
