// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "proc/settings/settings.h"

namespace orbwatch::app {

/// Quality and rate of a stream of JPEG pictures.
struct JpegSettings {
  int quality = 85;              ///< 1 to 100, the upper limit
  std::size_t target_bytes = 0;  ///< bytes of a picture; 0: no limit
  double rate = 0;               ///< pictures per second at most; 0: all
};

template <class Visitor>
void visit(Visitor& v, JpegSettings& jpeg) {
  v.optional("quality", jpeg.quality, Range::between(1, 100),
             "JPEG quality, the upper limit with target_bytes");
  v.optional("target_bytes", jpeg.target_bytes, Range::between(0, 1e8),
             "Size limit of one picture, bytes: the quality is lowered, down to 10, to meet it; 0: "
             "no limit");
  v.optional("rate", jpeg.rate, Range::between(0, 1000),
             "Limit of pictures per second and topic; 0: all");
}

/// Adapts the quality so that pictures stay below a size: down at once, in proportion to the
/// excess, and up again in small steps while there is room. Thread-bound.
class JpegQuality {
 public:
  static constexpr int kLeast = 10;

  explicit JpegQuality(const JpegSettings& settings)
      : best_(settings.quality), target_(settings.target_bytes), quality_(settings.quality) {}

  int current() const { return quality_; }

  /// Adapts to the size of a picture of the current quality. True: it was too large, and should be
  /// encoded again with the quality lowered; at most kMaxRepeats times for each picture.
  bool adapt(std::size_t bytes) {
    if (target_ == 0) return false;
    const double ratio = static_cast<double>(bytes) / static_cast<double>(target_);
    if (ratio > 1 && quality_ > kLeast && repeats_ < kMaxRepeats) {
      // Around the usual qualities, halving the size needs 20 to 40 steps.
      const int step = static_cast<int>(std::ceil(40 * std::log2(ratio)));
      quality_ = std::max(kLeast, quality_ - std::max(3, step));
      ++repeats_;
      return true;
    }
    repeats_ = 0;
    if (ratio < kRoom) quality_ = std::min(best_, quality_ + 1);
    return false;
  }

 private:
  static constexpr int kMaxRepeats = 4;
  /// Share of the target below which a picture permits a better quality.
  static constexpr double kRoom = 0.9;

  int best_;
  std::size_t target_;
  int quality_;
  int repeats_ = 0;
};

}  // namespace orbwatch::app
