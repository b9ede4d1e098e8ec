// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/counted_run.h"
#include "tests/bench/our_remap.h"

int main(int argc, char** argv) {
  return orbwatch::bench::counted_run<orbwatch::bench::OurRemap>(argc, argv);
}
