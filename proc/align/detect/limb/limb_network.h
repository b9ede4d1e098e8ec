// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/detect/limb/limb_strip.h"
#include "proc/align/detect/ring/ring_strip.h"

namespace orbwatch::align {

/// Probabilities of the limb's column in a strip, from a small convolutional network.
struct LimbColumns {
  /// Rays of the strip that one part of the limb covers.
  static constexpr int kRays = SlopeStrip::kTogether;

  int parts = 0;
  int columns = 0;
  /// Probability for each part and column; those of a part add up to 1 at most.
  std::vector<float> probabilities;

  const float* part(int n) const { return &probabilities[static_cast<std::size_t>(n * columns)]; }

  /// The angle of the middle of part `n`, radians.
  double angle(int n) const;
  /// Log-likelihood ratio of a limb there against anywhere, nats for each part and column. Some
  /// parts may be wrong: a mount hides the limb, a reflection looks like it.
  std::vector<float> above_random() const;
};

// At the limb a ball reflects its background, so that there is hardly a step of brightness. The
// limb shows in the slopes on both sides together: compressed along the normal inside, unaltered
// outside, blurred into each other between. The networks have learnt that from strips of simulated
// rooms: tests/proc/align/detect/learn_limb_network.py. Reentrant.

/// For a strip along the limb.
LimbColumns limb_columns(const LimbStrip& strip);

/// For a strip around a place within 0.3 radii of a ball's centre: less certain, at less cost.
LimbColumns limb_columns(const RingStrip& strip);

}  // namespace orbwatch::align
