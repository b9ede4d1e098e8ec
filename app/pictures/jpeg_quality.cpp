#include "app/pictures/jpeg_quality.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::app {

bool JpegQuality::adapt(std::size_t bytes) {
  if (target_ == 0) return false;
  const double ratio = static_cast<double>(bytes) / static_cast<double>(target_);
  if (ratio > 1 && quality_ > kLeast && repeats_ < kMaxRepeats) {
    // Around the usual qualities half the size takes 20 to 40 steps.
    const int step = static_cast<int>(std::ceil(40 * std::log2(ratio)));
    quality_ = std::max(kLeast, quality_ - std::max(3, step));
    ++repeats_;
    return true;
  }
  repeats_ = 0;
  if (ratio < kRoom) quality_ = std::min(best_, quality_ + 1);
  return false;
}

}  // namespace orbwatch::app
