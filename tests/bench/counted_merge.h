// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "tests/bench/merged_view.h"

namespace orbwatch::bench {

/// The main program run under a counter: "PROGRAM CASE REPETITIONS" merges a view REPETITIONS
/// times. The cost of one repetition is the difference between two runs that differ in REPETITIONS
/// only.
template <class Contestant>
int counted_merge(int argc, char** argv) {
  const auto wanted =
      argc == 3 ? std::ranges::find(kMergedCases, std::string_view(argv[1]), &MergedCase::name)
                : kMergedCases.end();
  const int repetitions = argc == 3 ? std::atoi(argv[2]) : 0;
  if (wanted == kMergedCases.end() || repetitions < 1 || !Contestant::takes(*wanted)) {
    std::cerr << "usage: " << argv[0] << " CASE REPETITIONS\n";
    return 2;
  }
  MergedView view(*wanted);
  Contestant contestant(view);
  for (int i = 0; i < repetitions; ++i) contestant.run();
  return 0;
}

}  // namespace orbwatch::bench
