// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/driver_format.h"

#include <linux/videodev2.h>

#include <algorithm>

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

DriverLayout driver_layout(const PixelCoding& coding, const DriverFormat& format) {
  DriverLayout layout;
  layout.memory_count = coding.memory_count;
  layout.largest = format.memory[0].bytes;
  const std::size_t row = packed_row_bytes(coding, static_cast<int>(format.width));
  const std::size_t first_stride = std::max<std::size_t>(format.memory[0].stride, row);
  if (coding.packing != Packing::None) {
    const bool rows = coding.packing != Packing::Jpeg;
    layout.plane_count = 1;
    layout.planes[0].stride = rows ? first_stride : 0;
    layout.needed[0] = rows ? first_stride * format.height : 1;
    return layout;
  }
  const PixelFormatInfo& facts = info(coding.format);
  layout.plane_count = facts.plane_count();
  for (std::size_t n = 0; n < layout.plane_count; ++n) {
    const PlaneInfo& plane = facts.planes[n];
    // Strides in one memory plane are in proportion to the first plane's.
    const auto in_proportion = [&](std::size_t stride) {
      return (stride * static_cast<std::size_t>(plane.samples) >> plane.shift_x) /
             static_cast<std::size_t>(facts.channels());
    };
    const std::size_t memory = std::min(n, coding.memory_count - 1);
    const std::size_t stride =
        memory == n ? std::max<std::size_t>(format.memory[n].stride, in_proportion(row))
                    : in_proportion(first_stride);
    layout.planes[n] = {memory, layout.needed[memory], stride};
    layout.needed[memory] += stride * (format.height >> plane.shift_y);
  }
  return layout;
}

}  // namespace orbwatch::hal
