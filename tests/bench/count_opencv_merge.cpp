// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/counted_merge.h"
#include "tests/bench/opencv_merge.h"

int main(int argc, char** argv) {
  return orbwatch::bench::counted_merge<orbwatch::bench::OpencvMerge>(argc, argv);
}
