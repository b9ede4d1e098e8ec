#pragma once

#include <cmath>

#include "proc/image/pixel_format.h"

namespace orbwatch::remap {

/// How samples follow light. Values are shares of full scale, 0..1.
enum class Transfer { Srgb, Linear };

/// What pictures of a format are taken to be: 16-bit counts are linear, all else is made for eyes.
constexpr Transfer transfer_of(PixelFormat format) {
  return format == PixelFormat::Y16 ? Transfer::Linear : Transfer::Srgb;
}

/// Sample to light. Source: IEC 61966-2-1.
inline double to_light(Transfer transfer, double sample) {
  if (transfer == Transfer::Linear) return sample;
  return sample <= 0.04045 ? sample / 12.92 : std::pow((sample + 0.055) / 1.055, 2.4);
}

/// Light to sample, the inverse of to_light().
inline double from_light(Transfer transfer, double light) {
  if (transfer == Transfer::Linear) return light;
  return light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace orbwatch::remap
