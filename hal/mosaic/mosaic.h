// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::hal {

/// Bayer pattern: the colours of the first two pixels of the first two rows.
enum class Mosaic : std::uint8_t { None, Rggb, Grbg, Gbrg, Bggr };

}  // namespace orbwatch::hal
