// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Darkest and brightest sample of 16-bit luminance.
struct GreyRange {
  std::uint16_t low = std::numeric_limits<std::uint16_t>::max(), high = 0;
};

/// True for luminance of more than 8 bit, which is stretched for people.
bool is_stretched(PixelFormat format);

/// Extends the range by the samples of a picture. Reentrant.
void extend(GreyRange& range, const ImageView<const std::uint16_t>& samples);

/// The samples, which are in the range, as 8 bit: from 0 for its darkest to 255 for its brightest.
/// Reentrant.
std::vector<std::uint8_t> stretched(const ImageView<const std::uint16_t>& samples,
                                    const GreyRange& range);

/// A picture as JPEG for people, valid until the encoder's next call. 16-bit luminance is stretched
/// from its darkest pixel to its brightest. Error: out of memory.
Result<std::span<std::uint8_t>> jpeg_for_people(JpegEncoder& encoder, const Picture& picture,
                                                int quality);

}  // namespace orbwatch::app::recorder
