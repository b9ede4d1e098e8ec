// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/counted_run.h"
#include "tests/bench/opencv_remap.h"

int main(int argc, char** argv) {
  return orbwatch::bench::counted_run<orbwatch::bench::OpencvRemap>(argc, argv);
}
