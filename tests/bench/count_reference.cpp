// SPDX-License-Identifier: Apache-2.0
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "tests/bench/reference_machine.h"

/// "PROGRAM FRAME_SETS" runs the reference machine, for count_stages.c: marks the beginning of each
/// frame set and prints the names of the stretches that the plugin counts.
int main(int argc, char** argv) {
  constexpr long kFrameSetBegins = 0x5E7;  // defined likewise in count_stages.c
  const int sets = argc == 2 ? std::atoi(argv[1]) : 0;
  if (sets < 2) {
    std::cerr << "usage: " << argv[0] << " FRAME_SETS, at least 2\n";
    return 2;
  }
  orbwatch::bench::ReferenceMachine machine([] { syscall(SYS_sched_yield, kFrameSetBegins, 0L); });
  for (int i = 0; i < sets; ++i) {
    if (machine.run()) continue;
    std::cerr << argv[0] << ": frame set " << i + 1 << " is not whole\n";
    return 1;
  }
  std::cout << orbwatch::bench::ReferenceMachine::kStretches << '\n';
  return 0;
}
