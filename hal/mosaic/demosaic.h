// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hal/mosaic/mosaic.h"
#include "proc/image/image_view.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Demosaics bilinearly: `samples` and `bgr` have the same size, 8 bit per sample; `bgr` is B G R.
/// Pixels on the picture's edge repeat their neighbours. Does not allocate if the process keeps
/// OpenCV on the calling thread, as orbwatchd does.
/// Errors: no mosaic, smaller than 4x4, other sizes. Reentrant.
Result<> demosaic(Mosaic mosaic, const ImageView<const std::uint8_t>& samples,
                  const ImageView<std::uint8_t>& bgr);

}  // namespace orbwatch::hal
