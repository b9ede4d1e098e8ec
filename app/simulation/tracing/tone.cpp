// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/tone.h"

#include <algorithm>
#include <cmath>

#include "proc/image/celsius.h"

namespace orbwatch::app::simulation {
namespace {

constexpr std::size_t kEncodedSteps = 4096;  // sufficient for the curve's steepest part, 12.92
constexpr int kHottest = 3000;               // degC, end of the table
constexpr int kDarkBelow = 500;              // degC, the Draper point

double srgb_of_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_of_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double wien(double nanometres, double celsius) {
  constexpr double kSecondRadiation = 1.438777e7;  // nm K
  return std::pow(nanometres, -5) *
         std::exp(-kSecondRadiation / (nanometres * (celsius + kZeroCelsius)));
}

}  // namespace

Tone::Tone() : encoded_(kEncodedSteps), glow_(kHottest + 1) {
  for (std::size_t i = 0; i < kEncodedSteps; ++i) {
    const double linear = static_cast<double>(i) / (kEncodedSteps - 1);
    encoded_[i] = static_cast<std::uint8_t>(std::lround(255 * srgb_of_linear(linear)));
  }
  for (std::size_t i = 0; i < linear_.size(); ++i) {
    linear_[i] = linear_of_srgb(static_cast<double>(i) / 255);
  }
  const double full_scale = wien(610, 1200);
  for (int celsius = kDarkBelow; celsius <= kHottest; ++celsius) {
    glow_[static_cast<std::size_t>(celsius)] =
        Light{wien(610, celsius), wien(550, celsius), wien(465, celsius)} * (1 / full_scale);
  }
}

const Light& Tone::incandescence(double celsius) const {
  return glow_[static_cast<std::size_t>(std::clamp(celsius, 0.0, double{kHottest}))];
}

std::uint8_t Tone::encode(double linear) const {
  const long step = std::lround(std::clamp(linear, 0.0, 1.0) * (kEncodedSteps - 1));
  return encoded_[static_cast<std::size_t>(step)];
}

}  // namespace orbwatch::app::simulation
