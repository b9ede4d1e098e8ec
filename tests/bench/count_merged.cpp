#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "tests/bench/merged_view.h"

/// "PROGRAM CASE REPETITIONS" merges a view that often, for count_instructions.c: two runs that
/// differ in REPETITIONS only tell what one costs.
int main(int argc, char** argv) {
  using namespace orbwatch::bench;
  const auto wanted =
      argc == 3 ? std::ranges::find(kMergedCases, std::string_view(argv[1]), &MergedCase::name)
                : kMergedCases.end();
  const int repetitions = argc == 3 ? std::atoi(argv[2]) : 0;
  if (wanted == kMergedCases.end() || repetitions < 1) {
    std::cerr << "usage: " << argv[0] << " CASE REPETITIONS\n";
    return 2;
  }
  MergedView view(*wanted);
  for (int i = 0; i < repetitions; ++i) view.run();
  return 0;
}
