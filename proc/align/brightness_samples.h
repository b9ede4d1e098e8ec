// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "proc/image/pixel_format.h"

namespace orbwatch::align {

/// The samples of a pixel, in a picture's first plane, that make its brightness.
enum class BrightnessSamples : std::uint8_t {
  First,         ///< is the brightness
  Second,        ///< likewise
  RedGreenBlue,  ///< the first three, by their weights in luma
  BlueGreenRed,  ///< likewise
};

constexpr BrightnessSamples brightness_samples(PixelFormat format) {
  switch (format) {
    case PixelFormat::Uyvy:
      return BrightnessSamples::Second;
    case PixelFormat::Rgb:
    case PixelFormat::Rgb16:
      return BrightnessSamples::RedGreenBlue;
    case PixelFormat::Bgr:
    case PixelFormat::Bgra:
      return BrightnessSamples::BlueGreenRed;
    case PixelFormat::Yuyv:
    case PixelFormat::Grey:
    case PixelFormat::Y10:
    case PixelFormat::Y12:
    case PixelFormat::Y16:
    case PixelFormat::Nv12:
    case PixelFormat::Nv21:
    case PixelFormat::I420:
      break;
  }
  return BrightnessSamples::First;
}

}  // namespace orbwatch::align
