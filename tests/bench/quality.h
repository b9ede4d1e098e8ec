// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/bench/frame.h"
#include "tests/bench/rig.h"

namespace orbwatch::bench {

/// Error of samples in units of 1/255 of full scale.
struct Quality {
  double rms = 0;
  double max = 0;
};

/// Compares the first plane of a view with bilinear interpolation in double at the exact places.
/// Only pixels that the rig defines count.
Quality quality_of(const Rig& rig, const Frame& source, const Frame& view);

}  // namespace orbwatch::bench
