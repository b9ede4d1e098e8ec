// SPDX-License-Identifier: Apache-2.0
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string_view>

#include "tests/bench/reference_machine.h"

/// "PROGRAM rgb|jpeg FRAME_SETS" runs the reference machine with readers of RGB or of JPEG, for
/// count_stages.c: marks the beginning of each frame set and prints the names of the stretches that
/// the plugin counts.
int main(int argc, char** argv) {
  constexpr long kFrameSetBegins = 0x5E7;  // defined likewise in count_stages.c
  using Machine = orbwatch::bench::ReferenceMachine;
  const std::string_view readers = argc == 3 ? argv[1] : "";
  const int sets = argc == 3 ? std::atoi(argv[2]) : 0;
  if ((readers != "rgb" && readers != "jpeg") || sets < 2) {
    std::cerr << "usage: " << argv[0] << " rgb|jpeg FRAME_SETS, at least 2\n";
    return 2;
  }
  Machine machine(readers == "rgb" ? Machine::ReadAs::Rgb : Machine::ReadAs::Jpeg,
                  [] { syscall(SYS_sched_yield, kFrameSetBegins, 0L); });
  for (int i = 0; i < sets; ++i) {
    if (machine.run()) continue;
    std::cerr << argv[0] << ": frame set " << i + 1 << " is not whole\n";
    return 1;
  }
  std::cout << Machine::kStretches << '\n';
  return 0;
}
