#pragma once

#include "tests/bench/dds_case.h"

namespace orbwatch::bench {

/// How long readers of another vendor and of ours wait, over a cable.
struct OutageFigures {
  double state_ms = 0;        ///< the last state, from matching on: the slowest of ten late readers
  double ours_back_s = 0;     ///< pictures, from the moment the cable is back after 15 s
  double foreign_back_s = 0;  ///< the same for the other vendor's reader
  double memory_growth_mb = 0;   ///< of the writing process while the cable was out
  unsigned long long waits = 0;  ///< of the pipeline, in all that time
  double longest_wait_ms = 0;

  bool reached() const {
    constexpr double kSoon = 100;
    constexpr double kBack = 5;
    constexpr double kFew = 8;  // megabytes: some pictures
    return state_ms <= kSoon && ours_back_s <= kBack && foreign_back_s <= kBack && waits == 0 &&
           memory_growth_mb <= kFew;
  }
};

/// Throws std::runtime_error when something never comes.
OutageFigures measure_outage();

void print(const OutageFigures& figures);

}  // namespace orbwatch::bench
