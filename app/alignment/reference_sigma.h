// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace orbwatch::app {

/// Standard error, degrees, of the directions of an alignment in force, which one that is measured
/// against it has, too: of a camera that is registered to it, or whose drift is corrected. It is
/// that of a placement by seven points; accepted alignments do not record their own.
inline constexpr double kReferenceSigma = 0.3;

}  // namespace orbwatch::app
