// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <charconv>
#include <iostream>
#include <optional>
#include <string_view>

#include "tests/bench/frame.h"
#include "tests/bench/rig.h"

namespace orbwatch::bench {

/// The format called `name` in kPixelFormats; nullopt when there is none.
inline std::optional<PixelFormat> find_format(std::string_view name) {
  for (const PixelFormatInfo& facts : kPixelFormats) {
    if (facts.name == name) return facts.format;
  }
  return {};
}

/// Marks a frame's memory for count_bytes.c.
inline void leave_out(const Frame& frame) {
  for (const Plane& plane : frame.planes) {
    syscall(SYS_sched_yield, plane.bytes.data(), plane.bytes.size());
  }
}
inline void begin_or_end_stretch() { syscall(SYS_sched_yield, nullptr, std::size_t{0}); }

/// The main program run under a counter: "PROGRAM VIEW FORMAT SIDE REPETITIONS" remaps white noise
/// of SIDE x SIDE pixels REPETITIONS times. The cost of one repetition is the difference between
/// two runs that differ in REPETITIONS only; the memory that it touches is marked.
template <class Contestant>
int counted_run(int argc, char** argv) {
  const auto number = [&](int i) {
    int value = 0;
    const std::string_view text = argv[i];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? value : 0;
  };
  if (argc != 5 || !find_view(argv[1]) || !find_format(argv[2]) || number(3) < 16 ||
      number(3) > kMaxSide || number(4) < 1) {
    std::cerr << "usage: " << argv[0] << " VIEW FORMAT SIDE REPETITIONS\n";
    return 2;
  }
  const Rig rig(*find_view(argv[1]), number(3));
  Frame source = Frame::blank(*find_format(argv[2]), rig.source, rig.source);
  source.fill_with_noise(1);
  Contestant contestant(rig, source);
  leave_out(source);
  leave_out(contestant.output());
  begin_or_end_stretch();
  for (int i = 0; i < number(4); ++i) contestant.run();
  begin_or_end_stretch();
  return 0;
}

}  // namespace orbwatch::bench
