// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <iostream>
#include <opencv2/core.hpp>

#include "tests/bench/watched_machine.h"

/// "PROGRAM REPETITIONS" watches two cameras for REPETITIONS times 10 s, the period of the focus,
/// after the references were taken; for count_instructions.c: the cost of one repetition is the
/// difference between two runs that differ in REPETITIONS only. Prints the number of frame sets of
/// one repetition.
int main(int argc, char** argv) {
  const int repetitions = argc == 2 ? std::atoi(argv[1]) : 0;
  if (repetitions < 0 || argc != 2) {
    std::cerr << "usage: " << argv[0] << " REPETITIONS\n";
    return 2;
  }
  cv::setNumThreads(1);
  orbwatch::bench::WatchedMachine machine;
  constexpr int kSets = 10 * orbwatch::bench::WatchedMachine::kSetsPerSecond;
  for (int n = 0; n < repetitions * kSets; ++n) {
    if (machine.look()) continue;
    std::cerr << argv[0] << ": the alignment or the focus is not measured as good in set " << n
              << '\n';
    return 1;
  }
  std::cout << kSets << '\n';
  return 0;
}
