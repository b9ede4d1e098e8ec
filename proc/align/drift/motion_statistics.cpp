// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/motion_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace orbwatch::align {
namespace {

/// Frames that count as one independent motion.
constexpr double kAlike = 2;
/// Divisor of the share that is left out at either end.
constexpr std::size_t kTrimmed = 5;

}  // namespace

void MotionStatistics::add(Time time, const PictureMotion& motion) {
  if (!motions_.empty() && time < motions_.back().time) restart();
  const auto old = std::ranges::find_if(
      motions_, [&](const Timed& timed) { return time - timed.time <= window_; });
  const auto spare =
      static_cast<std::ptrdiff_t>(motions_.size()) - static_cast<std::ptrdiff_t>(kFewest) + 1;
  motions_.erase(
      motions_.begin(),
      motions_.begin() + std::max<std::ptrdiff_t>(0, std::min(old - motions_.begin(), spare)));
  motions_.push_back({time, motion});
  mean_ = {trimmed_mean(&PictureMotion::u), trimmed_mean(&PictureMotion::v),
           trimmed_mean(&PictureMotion::growth), trimmed_mean(&PictureMotion::roll)};
  if (!is_complete()) return;
  double squares = 0;
  for (const Timed& timed : motions_) {
    const double apart = view_error_.small(timed.motion - mean_);
    squares += apart * apart;
  }
  spread_ = std::sqrt(squares / static_cast<double>(motions_.size()));
  knows_spread_ = true;
}

double MotionStatistics::sigma_of(double frames) const {
  return spread_ * std::sqrt(kAlike / std::max(1.0, frames));
}

double MotionStatistics::trimmed_mean(double PictureMotion::*component) {
  sorted_.clear();
  for (const Timed& timed : motions_) sorted_.push_back(timed.motion.*component);
  std::ranges::sort(sorted_);
  const auto trimmed = static_cast<std::ptrdiff_t>(sorted_.size() / kTrimmed);
  return std::accumulate(sorted_.begin() + trimmed, sorted_.end() - trimmed, 0.0) /
         static_cast<double>(static_cast<std::ptrdiff_t>(sorted_.size()) - 2 * trimmed);
}

}  // namespace orbwatch::align
