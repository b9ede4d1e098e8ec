// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/device/v4l2_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

#include "hal/v4l2/device/thermal_advice.h"
#include "hal/v4l2/device/v4l2_controls.h"
#include "hal/v4l2/format/v4l2_format.h"

namespace orbwatch::hal {
namespace {

namespace fs = std::filesystem;

constexpr std::array kLinkFolders{"v4l/by-id", "v4l/by-path"};

/// Sorted entries of a folder, which may be missing or change meanwhile.
std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    found.push_back(it->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Number of a node: "video12" is 12; -1 for other names.
int node_number(const fs::path& path) {
  constexpr std::string_view kPrefix = "video";
  const std::string name = path.filename().string();
  if (!name.starts_with(kPrefix) || name.size() == kPrefix.size() || name.size() > 10) return -1;
  const auto digits = name.substr(kPrefix.size());
  const bool number = std::all_of(digits.begin(), digits.end(),
                                  [](unsigned char c) { return std::isdigit(c) != 0; });
  return number ? std::stoi(digits) : -1;
}

std::vector<fs::path> nodes(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::path& path : entries(folder)) {
    if (node_number(path) >= 0) found.push_back(path);
  }
  std::ranges::sort(found, {}, node_number);
  return found;
}

std::vector<std::string> links_to(const fs::path& node, const fs::path& folder) {
  std::vector<std::string> found;
  for (const char* links : kLinkFolders) {
    for (const fs::path& link : entries(folder / links)) {
      std::error_code error;
      if (fs::equivalent(link, node, error) && !error) found.push_back(link.string());
    }
  }
  return found;
}

std::vector<CameraMode> modes_of(const V4l2Device& device) {
  std::vector<CameraMode> modes;
  for (const std::uint32_t fourcc : device.formats()) {
    const PixelCoding* const coding = find_coding(fourcc);
    const std::string format = coding ? std::string(coding->name) : fourcc_text(fourcc);
    for (const FrameSizeOffer& size : device.sizes(fourcc)) {
      modes.push_back(
          {format, size_text(size), device.frame_rates(fourcc, size.max_width, size.max_height)});
    }
  }
  return modes;
}

std::string advice_of(const V4l2Device& device) {
  std::string all;
  for (const std::uint32_t fourcc : device.formats()) {
    const std::vector<FrameSizeOffer> sizes = device.sizes(fourcc);
    const std::string advice = thermal_advice(fourcc, sizes);
    if (!advice.empty()) all += (all.empty() ? "" : "; ") + advice;
  }
  return all;
}

/// Menu entries as texts such as "1 = manual mode".
std::vector<std::string> menu_of(const V4l2Device& device, const v4l2_query_ext_ctrl& control) {
  std::vector<std::string> menu;
  if (control.type != V4L2_CTRL_TYPE_MENU && control.type != V4L2_CTRL_TYPE_INTEGER_MENU) {
    return menu;
  }
  constexpr std::int64_t kLongestMenu = 1024;
  const std::int64_t last = std::min(control.maximum, control.minimum + kLongestMenu);
  for (std::int64_t i = control.minimum; i <= last; ++i) {
    if (const auto text = device.menu_entry(control, i)) {
      menu.push_back(std::to_string(i) + " = " + *text);
    }
  }
  return menu;
}

std::string state_of(const v4l2_query_ext_ctrl& control) {
  if ((control.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0) return "read only";
  return (control.flags & V4L2_CTRL_FLAG_INACTIVE) != 0 ? "inactive" : "";
}

CameraControl entry_of(const V4l2Device& device, const v4l2_query_ext_ctrl& control) {
  return {.name = control_variable(control.name),
          .minimum = static_cast<double>(control.minimum),
          .maximum = static_cast<double>(control.maximum),
          .step = static_cast<double>(control.step),
          .default_value = static_cast<double>(control.default_value),
          .state = state_of(control),
          .values = menu_of(device, control)};
}

}  // namespace

CameraEntry describe(const V4l2Device& device) {
  CameraEntry entry{.id = device.path(),
                    .back_end = "v4l2",
                    .model = device.card(),
                    .driver = device.driver(),
                    .bus = device.bus(),
                    .paths = {device.path()},
                    .problem = {},
                    .advice = advice_of(device),
                    .modes = modes_of(device),
                    .controls = {}};
  for (auto control = device.next_control(0); control; control = device.next_control(control->id)) {
    if (takes_number(*control)) entry.controls.push_back(entry_of(device, *control));
  }
  return entry;
}

std::vector<CameraEntry> list_v4l2_cameras(const fs::path& folder) {
  std::vector<CameraEntry> cameras;
  for (const fs::path& node : nodes(folder)) {
    const auto device = V4l2Device::open(node.string());
    // Nodes of other kinds: outputs, codecs, metadata of cameras.
    if (!device && device.error().fault == Fault::WrongFormat) continue;
    CameraEntry camera;
    if (device) {
      camera = describe(*device);
    } else {
      camera.back_end = "v4l2";
      camera.problem = device.error().detail;
    }
    camera.paths = links_to(node, folder);
    camera.paths.push_back(node.string());
    camera.id = camera.paths.front();
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

DeviceResult<std::string> find_v4l2_device(const std::string& name, const fs::path& folder) {
  if (name.starts_with('/')) return name;
  std::error_code error;
  for (const char* links : kLinkFolders) {
    const fs::path link = folder / links / name;
    if (!name.empty() && fs::exists(link, error)) return link.string();
  }
  for (const fs::path& node : nodes(folder)) {
    const auto device = V4l2Device::open(node.string());
    if (device && device->bus() == name) return node.string();
  }
  return fail(Fault::Unplugged, "no V4L2 camera \"" + name + "\": no path, no link in " +
                                    (folder / "v4l").string() +
                                    " and no place on a bus of a camera");
}

}  // namespace orbwatch::hal
