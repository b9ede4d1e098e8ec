// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/connected_camera.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <type_traits>
#include <variant>

#include "app/files/plain_names.h"
#include "app/files/toml/toml_text.h"
#include "hal/inventory.h"
#include "hal/module/module_camera.h"
#include "hal/v4l2/device/v4l2_list.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

bool is_usb(const hal::CameraEntry& camera) {
  return camera.bus.starts_with("usb") || camera.id.find("usb") != std::string::npos;
}

bool is_usable(const hal::CameraEntry& camera) { return camera.problem.empty(); }

/// True: the back-end has a camera or recording of exactly this address.
template <class Settings>
bool is_place_of(const std::string& place) {
  constexpr hal::CameraOrigin kOrigin = Settings::kFacts.origin;
  std::error_code error;
  if constexpr (kOrigin == hal::CameraOrigin::Files) {
    return fs::is_directory(place, error) || fs::is_regular_file(place, error);
  } else if constexpr (kOrigin == hal::CameraOrigin::Kernel) {
    const auto device = hal::find_v4l2_device(place);
    return device && fs::exists(*device, error);
  } else if constexpr (kOrigin == hal::CameraOrigin::Module) {
    return std::ranges::any_of(hal::list_module_cameras(Settings::kName), [&](const auto& camera) {
      return camera.id == place || std::ranges::find(camera.paths, place) != camera.paths.end();
    });
  } else {
    return false;
  }
}

template <class Settings>
Settings settings_at(const std::string& place) {
  std::error_code error;
  const bool is_file = Settings::kFacts.origin == hal::CameraOrigin::Files;
  return Settings::at(is_file ? fs::canonical(place, error).string() : place);
}

/// Adds the usable cameras of a back-end, each once. `has_sensors`: another one has added sensors
/// of the board.
template <class Settings>
void add_connected(bool has_sensors, std::vector<CameraSource>& sources) {
  constexpr hal::BackEndFacts kFacts = Settings::kFacts;
  if constexpr (kFacts.origin == hal::CameraOrigin::Kernel) {
    for (const auto& camera : hal::list_v4l2_cameras()) {
      if (!is_usable(camera) || camera.modes.empty()) continue;
      if (is_usb(camera) || !has_sensors) sources.push_back({"", Settings::at(camera.id)});
    }
  } else if constexpr (kFacts.origin == hal::CameraOrigin::Module) {
    for (const auto& camera : hal::list_module_cameras(Settings::kName)) {
      const bool is_v4l2_too = kFacts.shares_usb && is_usb(camera);
      if (is_usable(camera) && !is_v4l2_too) sources.push_back({"", Settings::at(camera.id)});
    }
  }
}

}  // namespace

Result<CameraSource> camera_source(const std::string& word) {
  const std::size_t equals = word.find('=');
  const bool is_named = equals != std::string::npos && files::is_plain_name(word.substr(0, equals));
  CameraSource source{is_named ? word.substr(0, equals) : "", {}};
  const std::string place = is_named ? word.substr(equals + 1) : word;
  bool is_found = false;
  files::for_each_back_end([&]<class Settings>(std::type_identity<Settings>) {
    if (is_found || !is_place_of<Settings>(place)) return;
    is_found = true;
    if constexpr (!Settings::kFacts.address_key.empty())
      source.back_end = settings_at<Settings>(place);
  });
  if (is_found) return source;
  return fail(place +
              ": is not a folder, a picture or a camera; `orbwatch list` shows the cameras");
}

Result<std::vector<CameraSource>> connected_cameras() {
  std::vector<CameraSource> sources;
  // Board sensors first: their bare receivers are V4L2 devices, too.
  files::for_each_back_end([&]<class Settings>(std::type_identity<Settings>) {
    if constexpr (Settings::kFacts.has_board_sensors) add_connected<Settings>(false, sources);
  });
  const bool has_sensors = !sources.empty();
  files::for_each_back_end([&]<class Settings>(std::type_identity<Settings>) {
    if constexpr (!Settings::kFacts.has_board_sensors)
      add_connected<Settings>(has_sensors, sources);
  });
  if (!sources.empty()) return sources;
  return fail("no camera is connected; name pictures by --camera IMAGE, or see `orbwatch list`");
}

std::string back_end_text(const files::BackEndSettings& back_end) {
  const std::string name(std::visit([](const auto& settings) { return settings.kName; }, back_end));
  const std::string head = "back_end = " + files::toml_string(name) + "\n";
  const std::string key(files::facts_of(back_end).address_key);
  if (key.empty()) return head;
  return head + "\n[camera." + name + "]\n" + key + " = " +
         files::toml_string(files::address_of(back_end)) + "\n";
}

}  // namespace orbwatch::app::cli
