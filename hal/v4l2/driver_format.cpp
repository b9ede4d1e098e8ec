#include "hal/v4l2/driver_format.h"

#include <linux/videodev2.h>

namespace orbwatch::hal {

ColourSpace colour_space_of(const DriverFormat& format) {
  std::uint32_t encoding = format.ycbcr_enc;
  if (encoding == V4L2_YCBCR_ENC_DEFAULT) {
    encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(format.colorspace);
  }
  std::uint32_t range = format.quantization;
  if (range == V4L2_QUANTIZATION_DEFAULT) {
    range = format.colorspace == V4L2_COLORSPACE_JPEG ? V4L2_QUANTIZATION_FULL_RANGE
                                                      : V4L2_QUANTIZATION_LIM_RANGE;
  }
  const bool bt601 = encoding == V4L2_YCBCR_ENC_601 || encoding == V4L2_YCBCR_ENC_XV601;
  return {bt601 ? ColourMatrix::Bt601 : ColourMatrix::Bt709,
          range == V4L2_QUANTIZATION_FULL_RANGE ? ColourRange::Full : ColourRange::Limited};
}

}  // namespace orbwatch::hal
