// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/device/count_scale.h"

#include <algorithm>
#include <array>
#include <string>

namespace orbwatch::hal {
namespace {

/// A camera's linear count scale, as FLIR describes it: without an offset, from 0 K.
struct LinearScale {
  std::string_view feature;
  std::string_view value;
  std::string_view pixel_format;
  double kelvin_per_count;
};

/// IRFormat is the feature of the series A3x5, A6x5 and later ones, the other that of the series
/// Ax5.
constexpr std::array kLinearScales{
    LinearScale{"IRFormat", "TemperatureLinear10mK", "Mono16", 0.01},
    LinearScale{"IRFormat", "TemperatureLinear100mK", "Mono16", 0.1},
    LinearScale{"TemperatureLinearResolution", "High", "Mono14", 0.04},
    LinearScale{"TemperatureLinearResolution", "Low", "Mono14", 0.4},
};

/// Turns the linear scale of the series Ax5 on.
constexpr std::string_view kLinearMode = "TemperatureLinearMode";

/// A feature's value as a text; nullopt: the camera has no such feature.
std::optional<std::string> text_value_of(ArvCamera* camera, std::string_view feature) {
  const std::string name(feature);
  ArvDevice* const device = arv_camera_get_device(camera);
  ArvGcNode* const node = arv_device_get_feature(device, name.c_str());
  if (!ARV_IS_GC_FEATURE_NODE(node)) return std::nullopt;
  if (!arv_device_is_feature_available(device, name.c_str(), nullptr)) return std::nullopt;
  AravisError error;
  const std::string value =
      text_of(arv_gc_feature_node_get_value_as_string(ARV_GC_FEATURE_NODE(node), error.out()));
  if (error) return std::nullopt;
  return value;
}

CountScale scale_of(double kelvin_per_count, std::string_view feature, const std::string& value) {
  return {kelvin_per_count, std::string(feature) + " is " + value};
}

}  // namespace

std::optional<CountScale> read_count_scale(ArvCamera* camera, std::string_view pixel_format) {
  const auto mode = text_value_of(camera, kLinearMode);
  for (const LinearScale& row : kLinearScales) {
    if (row.pixel_format != pixel_format) continue;
    const auto value = text_value_of(camera, row.feature);
    if (!value) continue;
    if (mode && *mode != "On" && *mode != "true") return scale_of(0, kLinearMode, *mode);
    const auto* const found =
        std::ranges::find_if(kLinearScales, [&](const LinearScale& candidate) {
          return candidate.feature == row.feature && candidate.value == *value;
        });
    const bool is_linear = found != kLinearScales.end();
    return scale_of(is_linear ? found->kelvin_per_count : 0, row.feature, *value);
  }
  return std::nullopt;
}

bool would_rescale(ArvCamera* camera, std::string_view feature, double value) {
  const bool scales =
      feature == kLinearMode ||
      std::ranges::find(kLinearScales, feature, &LinearScale::feature) != kLinearScales.end();
  if (!scales) return false;
  ArvDevice* const device = arv_camera_get_device(camera);
  ArvGcNode* const node = arv_device_get_feature(device, std::string(feature).c_str());
  if (!ARV_IS_GC_ENUMERATION(node)) return true;
  AravisError error;
  const auto now = arv_gc_enumeration_get_int_value(ARV_GC_ENUMERATION(node), error.out());
  return error || static_cast<double>(now) != value;
}

}  // namespace orbwatch::hal
