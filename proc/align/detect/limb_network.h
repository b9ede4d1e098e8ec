#pragma once

#include <vector>

#include "proc/align/detect/limb_strip.h"
#include "proc/align/detect/ring_strip.h"

namespace orbwatch::align {

/// Where the limb crosses a strip, as a small convolutional network sees it.
struct LimbColumns {
  /// Rays of the strip that one part of the limb stands for.
  static constexpr int kRays = SlopeStrip::kTogether;

  int parts = 0;
  int columns = 0;
  std::vector<float> probabilities;  ///< by part and column; those of a part add up to 1 at most

  const float* part(int n) const { return &probabilities[static_cast<std::size_t>(n * columns)]; }

  /// The angle of a part's middle in a strip of that many parts, radians.
  double angle(int n) const;
  /// By how much a limb there is likelier than anywhere, nats by part and column. Some parts may
  /// be wrong: a mount hides the limb, a reflection looks like it.
  std::vector<float> above_random() const;
};

// At the limb a ball reflects what is behind it, so that there is hardly a step of brightness. What
// tells it is how slopes on both sides look together: compressed along the normal inside, as they
// come outside, blurred into each other between. The networks have learnt that from strips of
// simulated rooms: tests/proc/align/detect/learn_limb_network.py. Reentrant.

/// Of a strip along the limb.
LimbColumns limb_columns(const LimbStrip& strip);

/// Of a strip around a place within 0.3 radii of a ball's centre: with less certainty, at less
/// cost.
LimbColumns limb_columns(const RingStrip& strip);

}  // namespace orbwatch::align
