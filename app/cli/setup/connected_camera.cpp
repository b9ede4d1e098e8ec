#include "app/cli/setup/connected_camera.h"

#include <algorithm>
#include <filesystem>
#include <type_traits>
#include <variant>

#include "app/files/plain_names.h"
#include "app/files/toml_text.h"
#include "hal/inventory.h"
#include "hal/module/module_camera.h"
#include "hal/v4l2/device/v4l2_list.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

hal::V4l2Settings v4l2(const std::string& device) { return {.device = device}; }
hal::LibcameraSettings libcamera(const std::string& id) { return {.camera = id}; }
hal::GenicamSettings genicam(const std::string& name) {
  hal::GenicamSettings settings;
  settings.camera = name;
  return settings;
}

std::vector<hal::CameraEntry> libcamera_cameras() {
  return hal::list_module_cameras(hal::LibcameraSettings::kName);
}

std::vector<hal::CameraEntry> genicam_cameras() {
  return hal::list_module_cameras(hal::GenicamSettings::kName);
}

bool is_usb(const hal::CameraEntry& camera) {
  return camera.bus.starts_with("usb") || camera.id.find("usb") != std::string::npos;
}

bool is_usable(const hal::CameraEntry& camera) { return camera.problem.empty(); }

}  // namespace

Result<CameraSource> camera_source(const std::string& word) {
  const std::size_t equals = word.find('=');
  const bool is_named = equals != std::string::npos && is_plain_name(word.substr(0, equals));
  CameraSource source{is_named ? word.substr(0, equals) : "", {}};
  const std::string place = is_named ? word.substr(equals + 1) : word;
  std::error_code error;
  if (fs::is_directory(place, error) || fs::is_regular_file(place, error)) {
    hal::ReplaySettings replay;
    replay.source = fs::canonical(place, error);
    replay.loop = false;
    source.back_end = replay;
    return source;
  }
  if (hal::find_v4l2_device(place) && fs::exists(*hal::find_v4l2_device(place), error)) {
    source.back_end = v4l2(place);
    return source;
  }
  const auto cameras = libcamera_cameras();
  if (std::ranges::any_of(cameras, [&](const auto& c) { return is_usable(c) && c.id == place; })) {
    source.back_end = libcamera(place);
    return source;
  }
  if (std::ranges::any_of(genicam_cameras(), [&](const auto& c) {
        return c.id == place || std::ranges::find(c.paths, place) != c.paths.end();
      })) {
    source.back_end = genicam(place);
    return source;
  }
  return fail(place +
              ": is no folder, no picture and no camera; `orbwatch list` shows the cameras");
}

Result<std::vector<CameraSource>> connected_cameras() {
  std::vector<CameraSource> sources;
  for (const auto& camera : libcamera_cameras()) {
    // A USB camera's own driver knows more controls and rates of it.
    if (is_usable(camera) && !is_usb(camera)) sources.push_back({"", libcamera(camera.id)});
  }
  // The bare receivers of sensors that libcamera serves are no cameras by themselves.
  const bool has_sensors = !sources.empty();
  for (const auto& camera : hal::list_v4l2_cameras()) {
    if (!is_usable(camera) || camera.modes.empty()) continue;
    if (is_usb(camera) || !has_sensors) sources.push_back({"", v4l2(camera.id)});
  }
  for (const auto& camera : genicam_cameras()) {
    if (is_usable(camera)) sources.push_back({"", genicam(camera.id)});
  }
  if (!sources.empty()) return sources;
  return fail("no camera is connected; name pictures by --camera IMAGE, or see `orbwatch list`");
}

std::string back_end_text(const BackEndSettings& back_end) {
  return std::visit(
      []<class Settings>(const Settings& settings) {
        const std::string name(Settings::kName);
        const std::string head = "back_end = " + toml_string(name) + "\n";
        const std::string table = "\n[camera." + name + "]\n";
        if constexpr (std::is_same_v<Settings, hal::ReplaySettings>) {
          return head + table + "source = " + toml_string(settings.source.string()) + "\n";
        } else if constexpr (std::is_same_v<Settings, hal::V4l2Settings>) {
          return head + table + "device = " + toml_string(settings.device) + "\n";
        } else if constexpr (std::is_same_v<Settings, hal::LibcameraSettings> ||
                             std::is_same_v<Settings, hal::GenicamSettings>) {
          return head + table + "camera = " + toml_string(settings.camera) + "\n";
        } else {
          return head;
        }
      },
      back_end);
}

}  // namespace orbwatch::app
