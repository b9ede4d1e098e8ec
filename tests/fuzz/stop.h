// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace orbwatch::fuzz {

/// Stops the process so that libFuzzer keeps the input.
[[noreturn]] inline void stop(const std::string& why) {
  std::fprintf(stderr, "fuzz: %s\n", why.c_str());
  std::abort();
}

inline void require(bool truth, const char* why) {
  if (!truth) stop(why);
}

}  // namespace orbwatch::fuzz
