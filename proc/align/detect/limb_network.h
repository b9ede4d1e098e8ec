#pragma once

#include <vector>

#include "proc/align/detect/limb_strip.h"

namespace orbwatch::align {

/// Where the limb crosses a strip, as a small convolutional network sees it.
struct LimbColumns {
  /// Rays of the strip that one part of the limb stands for.
  static constexpr int kRays = LimbStrip::kTogether;

  int parts = 0;
  int columns = 0;
  std::vector<float> probabilities;  ///< by part and column; those of a part add up to 1

  const float* part(int n) const { return &probabilities[static_cast<std::size_t>(n * columns)]; }
};

/// At the limb a ball reflects what is behind it, so that there is hardly a step of brightness.
/// What tells it is how slopes on both sides look together: compressed along the normal inside,
/// as they come outside, blurred into each other between. The network has learnt that from strips
/// around the limbs of simulated rooms: tests/proc/align/detect/learn_limb_network.py. Reentrant.
LimbColumns limb_columns(const LimbStrip& strip);

}  // namespace orbwatch::align
