// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

/// Partial runs of long statistical gates: a tenth of their seeded cases, or the share in the
/// environment variable ORBWATCH_SHARE; tests/acceptance/run runs them completely and reports those
/// that use this header.
namespace orbwatch::tests {

/// The share, above 0, at most 1.
inline double share() {
  const char* const text = std::getenv("ORBWATCH_SHARE");
  const double value = text != nullptr ? std::stod(text) : 0.1;
  if (!(value > 0 && value <= 1)) throw std::invalid_argument("ORBWATCH_SHARE");
  return value;
}

/// Number of a gate's `cases` that run, at least one: the first ones of a seeded loop.
inline int share_of(int cases) {
  const int run = std::max(1, static_cast<int>(std::lround(share() * cases)));
  testing::Test::RecordProperty("cases_run", run);
  testing::Test::RecordProperty("cases", cases);
  return run;
}

/// Selection of the cases that run for a gate whose cases are listed, not drawn: the same ones
/// every time, from all over the list.
class DrawnShare {
 public:
  explicit DrawnShare(int cases) : runs_(static_cast<std::size_t>(cases), false) {
    std::vector<int> order(runs_.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    for (int n = share_of(cases) - 1; n >= 0; --n) {
      runs_[static_cast<std::size_t>(order[static_cast<std::size_t>(n)])] = true;
    }
  }
  /// True if the next case runs; throws when there are more than were announced.
  bool next() { return runs_.at(next_++); }

 private:
  std::vector<bool> runs_;
  std::size_t next_ = 0;
};

}  // namespace orbwatch::tests
