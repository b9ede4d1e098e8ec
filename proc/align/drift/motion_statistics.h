// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "proc/align/drift/picture_motion.h"
#include "proc/align/drift/view_error.h"

namespace orbwatch::align {

/// Statistics of the motions of the last frames: their mean without the effect of vibration, and
/// its accuracy. Not reentrant.
class MotionStatistics {
 public:
  using Time = std::chrono::nanoseconds;

  /// `view_error` outlives it. Keeps `window`, and at least kFewest motions.
  MotionStatistics(const ViewError& view_error, Time window)
      : view_error_(view_error), window_(window) {}

  static constexpr std::size_t kFewest = 8;

  /// `time` of any clock that does not jump; an earlier time than the last one restarts.
  void add(Time time, const PictureMotion& motion);

  /// Drops the motions, keeps their spread.
  void restart() { motions_.clear(); }

  bool empty() const { return motions_.empty(); }
  /// True: there are enough motions for a mean and a spread.
  bool is_complete() const { return motions_.size() >= kFewest; }
  /// False until they were complete once: spread() and sigma() are 0, and mean nothing.
  bool knows_spread() const { return knows_spread_; }

  /// Mean of each component, without its lowest and highest fifth.
  PictureMotion mean() const { return mean_; }
  /// Deviation of single motions from the mean, rms degrees of view direction.
  double spread() const { return spread_; }
  /// Standard deviation of the mean, degrees; accounts for vibration, which makes neighbours alike.
  double sigma() const { return sigma_of(static_cast<double>(motions_.size())); }
  /// The same for the mean of `frames` frames.
  double sigma_of(double frames) const;

 private:
  struct Timed {
    Time time;
    PictureMotion motion;
  };

  double trimmed_mean(double PictureMotion::*component);

  const ViewError& view_error_;
  Time window_;
  std::vector<Timed> motions_;
  std::vector<double> sorted_;
  PictureMotion mean_;
  double spread_ = 0;
  bool knows_spread_ = false;
};

}  // namespace orbwatch::align
