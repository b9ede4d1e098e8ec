// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/genicam/format/genicam_format.h"

namespace orbwatch::hal {

/// Unpacks a row of `width` samples, whole groups of the packing, which is not None, into the low
/// bits of 16. Reentrant.
void unpack_samples(SamplePacking packing, const std::byte* row, int width, std::uint16_t* samples);

/// Extracts the upper 8 of the format's bits of each sample of a row, in any packing. Reentrant.
void unpack_upper_bits(const GenicamFormat& format, const std::byte* row, int width,
                       std::uint8_t* samples);

}  // namespace orbwatch::hal
