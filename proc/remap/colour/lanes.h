#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The arithmetic of colour conversion for 16 pixels side by side, in Q14 integers of 32 bits:
/// `lanes_neon.h` where compilers do not find the processor's instructions by themselves, else
/// `lanes_any.h`, whose loops become vector code. Both give the same.
namespace orbwatch::remap {

/// So many pixels side by side are converted together.
inline constexpr std::size_t kRun = 16;

/// One 8 bit sample of each pixel of a run.
using SampleRun = std::array<std::uint8_t, kRun>;

}  // namespace orbwatch::remap

#ifdef __aarch64__
#include "proc/remap/colour/lanes_neon.h"
#else
#include "proc/remap/colour/lanes_any.h"
#endif
