// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/device/thermal_advice.h"

#include <algorithm>
#include <array>

#include "hal/v4l2/format/pixel_coding.h"
#include "hal/v4l2/format/v4l2_format.h"

namespace orbwatch::hal {
namespace {

/// Picture and the telemetry lines that FLIR's Lepton adds to it.
struct Telemetry {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t lines;
};

constexpr std::array kLeptons{Telemetry{80, 60, 3}, Telemetry{160, 120, 2}};

bool is_one_size(const FrameSizeOffer& size) {
  return size.min_width == size.max_width && size.min_height == size.max_height;
}

bool has_size(std::span<const FrameSizeOffer> sizes, std::uint32_t width, std::uint32_t height) {
  return std::ranges::any_of(sizes, [&](const FrameSizeOffer& size) {
    return is_one_size(size) && size.min_width == width && size.min_height == height;
  });
}

std::string size_keys(std::uint32_t width, std::uint32_t height) {
  return "[[camera]] width = " + std::to_string(width) + ", height = " + std::to_string(height);
}

/// No other camera's frames are higher than wide, or also offered in half their height.
std::string stacked_advice(const FrameSizeOffer& size, std::span<const FrameSizeOffer> sizes) {
  const std::uint32_t width = size.min_width, height = size.min_height, half = height / 2;
  const bool is_stacked = height % 2 == 0 && (height > width || has_size(sizes, width, half));
  if (!is_stacked) return {};
  return size_text(size) +
         " may be a picture above 16 bit words of temperature: " + size_keys(width, half) +
         ", kelvin_per_count of the data sheet; [camera.v4l2] " + "pixel_format = \"" +
         std::string(kWordsAsYuyv.name) + "\", frame_height = " + std::to_string(height) +
         ", first_row = " + std::to_string(half);
}

std::string telemetry_advice(const FrameSizeOffer& size, std::span<const FrameSizeOffer> sizes) {
  const auto* const lepton = std::ranges::find_if(kLeptons, [&size](const Telemetry& known) {
    return known.width == size.min_width && known.height + known.lines == size.min_height;
  });
  if (lepton == kLeptons.end()) return {};
  std::string text = size_text(size) + " has " + std::to_string(lepton->lines) +
                     " lines of telemetry: " + size_keys(lepton->width, lepton->height);
  if (has_size(sizes, lepton->width, lepton->height)) return text;
  return text + "; [camera.v4l2] frame_height = " + std::to_string(size.min_height) +
         ", and first_row = " + std::to_string(lepton->lines) + " if they are at the top";
}

}  // namespace

std::string thermal_advice(std::uint32_t fourcc, std::span<const FrameSizeOffer> sizes) {
  std::string all;
  for (const FrameSizeOffer& size : sizes) {
    if (!is_one_size(size)) continue;
    std::string advice;
    if (fourcc == kWordsAsYuyv.fourcc) advice = stacked_advice(size, sizes);
    if (fourcc == V4L2_PIX_FMT_Y16) advice = telemetry_advice(size, sizes);
    if (!advice.empty()) all += (all.empty() ? "" : "; ") + advice;
  }
  return all;
}

}  // namespace orbwatch::hal
