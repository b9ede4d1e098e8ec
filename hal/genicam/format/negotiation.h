// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "hal/camera.h"
#include "hal/genicam/device/aravis.h"
#include "hal/genicam/format/genicam_format.h"
#include "hal/genicam/genicam_settings.h"

namespace orbwatch::hal {

/// Format that a camera will send, and the format of its decoded frames.
struct GenicamStreamFormat {
  const GenicamFormat* pixels = nullptr;  ///< entry in kGenicamFormats
  StreamFormat stream;                    ///< frame rate 0: unknown
  std::size_t payload = 0;                ///< bytes of a buffer

  bool is_zero_copy() const {
    return pixels->packing == SamplePacking::None && stream.format == pixels->format;
  }
  /// Bytes from row to row when each ends with `padding`.
  std::size_t stride(std::size_t padding) const {
    return sent_row_bytes(*pixels, stream.width) + padding;
  }
};

/// Sets pixel format, binning, size, offset on the sensor and rate of an open camera, which then
/// runs freely. `pixel_format` is "auto", the first of kGenicamFormats that the camera has, or a
/// name. The size is honoured or refused with the camera's limits; the rate is the nearest that the
/// camera has.
DeviceResult<GenicamStreamFormat> negotiate(ArvCamera* camera, const GenicamSettings& settings,
                                            std::string_view pixel_format,
                                            const StreamRequest& request);

/// Pixel formats that a camera offers, by PFNC code.
std::vector<std::uint32_t> offered_formats(ArvCamera* camera);

/// The camera's name of a format, or PFNC's, or its code.
std::string format_name(std::uint32_t code);

}  // namespace orbwatch::hal
