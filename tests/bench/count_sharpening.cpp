// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <utility>

#include "proc/remap/remap.h"
#include "tests/bench/counted_run.h"

/// "PROGRAM FORMAT REPETITIONS" sharpens 1000x1000 pixels of a picture of 1920x1080 REPETITIONS
/// times, in the bands of rows that threads share, for count_instructions.c: the cost of one
/// repetition is the difference between two runs that differ in REPETITIONS only.
int main(int argc, char** argv) {
  using namespace orbwatch;
  constexpr remap::SourceArea kBall{459, 40, 1459, 1040};
  constexpr int kBand = 32;
  const auto format = argc == 3 ? bench::find_format(argv[1]) : std::nullopt;
  const int repetitions = argc == 3 ? std::atoi(argv[2]) : 0;
  if (!format || !remap::can_sharpen(*format) || repetitions < 1) {
    std::cerr << "usage: " << argv[0] << " FORMAT REPETITIONS\n";
    return 2;
  }
  bench::Frame frame = bench::Frame::blank(*format, 1920, 1080);
  frame.fill_with_noise(1);
  remap::SharpenedPicture sharpened(*format, frame.width, frame.height, 0.8);
  sharpened.set_source(std::as_const(frame).picture());
  for (int i = 0; i < repetitions; ++i) {
    for (int top = kBall.top; top < kBall.bottom; top += kBand) {
      sharpened.fill({kBall.left, top, kBall.right, std::min(kBall.bottom, top + kBand)});
    }
  }
  return 0;
}
