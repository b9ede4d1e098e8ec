// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "tests/bench/measured_region.h"

/// "PROGRAM CASE REPETITIONS" measures a region REPETITIONS times, for count_instructions.c: the
/// cost of one repetition is the difference between two runs that differ in REPETITIONS only.
/// Prints the region's pixels.
int main(int argc, char** argv) {
  using namespace orbwatch::bench;
  const auto wanted =
      argc == 3 ? std::ranges::find(kRegionCases, std::string_view(argv[1]), &RegionCase::name)
                : kRegionCases.end();
  const int repetitions = argc == 3 ? std::atoi(argv[2]) : 0;
  if (wanted == kRegionCases.end() || repetitions < 1) {
    std::cerr << "usage: " << argv[0] << " CASE REPETITIONS\n";
    return 2;
  }
  MeasuredRegion region(*wanted);
  for (int i = 0; i < repetitions; ++i) region.run();
  std::cout << region.pixels() << '\n';
  return 0;
}
