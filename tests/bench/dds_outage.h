// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/bench/dds_case.h"

namespace orbwatch::bench {

/// Delays of another vendor's readers and of ours, over a cable.
struct OutageFigures {
  double state_ms = 0;  ///< delay of the last state after matching: the slowest of ten late readers
  double ours_back_s = 0;     ///< delay of pictures after the cable is back from an outage of 15 s
  double foreign_back_s = 0;  ///< the same for the other vendor's reader
  double memory_growth_mb = 0;   ///< the writing process's while the cable was out
  unsigned long long waits = 0;  ///< the pipeline's during the whole measurement
  double longest_wait_ms = 0;

  bool reached() const {
    constexpr double kSoon = 100;
    constexpr double kBack = 5;
    constexpr double kFew = 8;  // megabytes: some pictures
    return state_ms <= kSoon && ours_back_s <= kBack && foreign_back_s <= kBack && waits == 0 &&
           memory_growth_mb <= kFew;
  }
};

/// Throws std::runtime_error when an expected sample is not received.
OutageFigures measure_outage();

void print(const OutageFigures& figures);

}  // namespace orbwatch::bench
