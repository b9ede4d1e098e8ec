#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/v4l2/format/pixel_coding.h"

namespace orbwatch::hal {

/// Unpacks a row of `width` samples into the low bits of 16. The packing is one of luminance:
/// Mipi10, Mipi12 or BigEndian. Reentrant.
void unpack_row(Packing packing, const std::byte* row, int width, std::uint16_t* samples);

/// The upper 8 bits of each sample of a row of luminance with `bits` per sample (8, 10, 12 or 16),
/// in any packing but Jpeg. Reentrant.
void unpack_row_to_8_bit(Packing packing, int bits, const std::byte* row, int width,
                         std::uint8_t* samples);

}  // namespace orbwatch::hal
