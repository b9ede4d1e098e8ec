#pragma once

#include <cstdint>

#include "proc/image/image_view.h"

namespace orbwatch::hal {

/// Writes planes of U and V as the U V pairs of Nv12: `pairs`, 2 channels, one pixel for 2x2 of the
/// picture. The planes have as many pixels as `pairs` in each direction, twice as many, which are
/// averaged, or half as many columns, which are repeated; empty planes become neutral chroma.
/// Reentrant.
void interleave_chroma(const ImageView<const std::uint8_t>& u,
                       const ImageView<const std::uint8_t>& v,
                       const ImageView<std::uint8_t>& pairs);

}  // namespace orbwatch::hal
