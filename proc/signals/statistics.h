// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/signals/last_second.h"
#include "proc/signals/signals.h"

namespace orbwatch::signals {

/// Mean, standard deviation and trend of one signal's valid values over the last second. No
/// allocation. Thread-bound.
class Statistics {
 public:
  /// Adds the signal's value at `now`, s; ignores kNotValid. `now` is monotonic.
  void add(double now, double value);

  void reset() { bins_.clear(); }

  struct Figures {
    double mean = kNotValid;       ///< needs at least one value
    double deviation = kNotValid;  ///< sample deviation (n - 1), needs at least two values
    double trend = kNotValid;  ///< slope of the least-squares line per second, needs two moments
  };
  Figures figures() const;

 private:
  /// Centred sums, which stay exact for large values and times.
  struct Moments {
    double count = 0;
    double time = 0;   ///< mean, s
    double value = 0;  ///< mean
    double time_time = 0;
    double time_value = 0;
    double value_value = 0;

    /// Chan, Golub, LeVeque: Updating formulae and a pairwise algorithm for computing sample
    /// variances, 1979.
    void join(const Moments& other);
  };

  LastSecond<Moments> bins_;
};

}  // namespace orbwatch::signals
