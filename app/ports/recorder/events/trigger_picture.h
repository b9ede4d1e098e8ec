// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// A picture as JPEG for people, valid until the encoder's next call. 16-bit luminance is stretched
/// from its darkest pixel to its brightest. Error: out of memory.
Result<std::span<std::uint8_t>> jpeg_for_people(JpegEncoder& encoder, const Picture& picture,
                                                int quality);

}  // namespace orbwatch::app::recorder
