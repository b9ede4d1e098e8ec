#pragma once

#include <cstdint>

#include "proc/image/image_view.h"

namespace orbwatch::hal {

/// Interleaves planes of U and V as Nv12: `pairs` has 2 channels and one pixel for 2x2 of the
/// picture. In each direction the planes have as many pixels as `pairs`, twice as many (averaged),
/// or half as many columns (repeated); empty planes become neutral chroma. Reentrant.
void interleave_chroma(const ImageView<const std::uint8_t>& u,
                       const ImageView<const std::uint8_t>& v,
                       const ImageView<std::uint8_t>& pairs);

}  // namespace orbwatch::hal
