// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/control_ids.h>
#include <libcamera/controls.h>

#include <cstdint>

namespace orbwatch::hal {

/// Controls that a camera with a focusing lens might offer.
inline libcamera::ControlInfoMap offered_controls() {
  namespace controls = libcamera::controls;
  using libcamera::ControlInfo;
  return libcamera::ControlInfoMap(
      {{&controls::ExposureTime, ControlInfo(std::int32_t{75}, std::int32_t{11766829})},
       {&controls::AnalogueGain, ControlInfo(1.0F, 10.5F)},
       {&controls::AeEnable, ControlInfo(false, true)},
       {&controls::AwbEnable, ControlInfo(false, true)},
       {&controls::ColourGains, ControlInfo(0.0F, 32.0F)},
       {&controls::LensPosition, ControlInfo(0.0F, 15.0F, 1.0F)},
       {&controls::Saturation, ControlInfo(0.0F, 32.0F)},
       {&controls::FrameDurationLimits, ControlInfo(std::int64_t{21000}, std::int64_t{12000000})},
       {&controls::ScalerCrop, ControlInfo(libcamera::Rectangle(), libcamera::Rectangle())}},
      controls::controls);
}

}  // namespace orbwatch::hal
