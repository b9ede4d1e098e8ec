#pragma once

#include <cstdint>

#include "hal/v4l2/format/pixel_coding.h"
#include "proc/image/image_view.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Called before the first demosaic(): switches OpenCV's own threads off in the whole process, as
/// each camera has a thread already.
void prepare_demosaic();

/// Demosaics bilinearly: `samples` and `bgr` have the same size, 8 bit per sample; `bgr` is B G R.
/// Pixels on the picture's edge repeat their neighbours. On the calling thread, without allocation.
/// Errors: no mosaic, smaller than 4x4, other sizes. Reentrant.
Result<> demosaic(Mosaic mosaic, const ImageView<const std::uint8_t>& samples,
                  const ImageView<std::uint8_t>& bgr);

}  // namespace orbwatch::hal
