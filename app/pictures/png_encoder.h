// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Encodes a Grey, Y16, Rgb, Bgr or Rgb16 picture as PNG, for speed rather than size. With
/// `validity`, of the picture's size, pixels that are not Validity::Seen become transparent. Error:
/// out of memory. Reentrant.
Result<std::vector<std::uint8_t>> encode_png(const Picture& picture,
                                             const ImageView<const std::uint8_t>& validity = {});

}  // namespace orbwatch::app
