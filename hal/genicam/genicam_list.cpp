// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/genicam_list.h"

#include <string>

#include "hal/genicam/device/features.h"
#include "hal/genicam/device/found_camera.h"
#include "hal/genicam/device/open_camera.h"
#include "hal/genicam/format/negotiation.h"
#include "hal/genicam/genicam_settings.h"

namespace orbwatch::hal {
namespace {

std::string range_text(const CameraControl& control) {
  return std::to_string(static_cast<long>(control.minimum)) + ".." +
         std::to_string(static_cast<long>(control.maximum));
}

/// Limits of each side: "1..2048x1..1088".
std::string size_text(const std::vector<CameraControl>& controls) {
  std::string width = "?", height = "?";
  for (const CameraControl& control : controls) {
    if (control.name == "Width") width = range_text(control);
    if (control.name == "Height") height = range_text(control);
  }
  return width + "x" + height;
}

CameraEntry entry_of(const FoundCamera& found) {
  CameraEntry entry;
  entry.id = found.id;
  entry.back_end = GenicamSettings::kName;
  entry.model = found.model;
  entry.driver = found.protocol;
  entry.bus = found.address;
  entry.paths = {found.serial, found.address};
  if (!found.name.empty()) entry.paths.push_back(found.name);
  const auto camera = open_camera(found);
  if (!camera) {
    entry.problem = camera.error().detail;
    return entry;
  }
  entry.controls = list_features(camera->get());
  const std::string size = size_text(entry.controls);
  for (const std::uint32_t code : offered_formats(camera->get())) {
    entry.modes.push_back({format_name(code), size, {}});
  }
  return entry;
}

}  // namespace

std::vector<CameraEntry> list_genicam_cameras() {
  std::vector<CameraEntry> entries;
  for (const FoundCamera& found : find_cameras()) entries.push_back(entry_of(found));
  return entries;
}

}  // namespace orbwatch::hal
