#pragma once

#include <cstdint>

#include "proc/remap/kernel.h"

namespace orbwatch::remap {

/// Writes `width` pixels, each the mean of 2x2 from two rows of a plane, rounded to nearest: the
/// samples that the layout takes, to where they stand in a pixel.
using HalveRow = void (*)(const std::uint8_t* upper, const std::uint8_t* lower, std::uint8_t* out,
                          int width);
HalveRow halve_row(Layout layout);

}  // namespace orbwatch::remap
