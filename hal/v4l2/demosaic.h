#pragma once

#include <cstdint>

#include "hal/v4l2/pixel_coding.h"
#include "proc/image/image_view.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// To be called before the first demosaic(): keeps OpenCV, in the whole process, from sharing work
/// with threads of its own, as each camera has one.
void prepare_demosaic();

/// Colours of a sensor's mosaic, bilinear: `bgr` gets B G R of 8 bit and has the size of `samples`,
/// 8 bit each. The pixels on the picture's edge repeat their neighbours. On the calling thread
/// alone, without allocation. Errors: no mosaic, smaller than 4x4, other sizes. Reentrant.
Result<> demosaic(Mosaic mosaic, const ImageView<const std::uint8_t>& samples,
                  const ImageView<std::uint8_t>& bgr);

}  // namespace orbwatch::hal
