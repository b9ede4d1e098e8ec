#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

#include "app/cli/list.h"
#include "hal/v4l2/v4l2_controls.h"
#include "hal/v4l2/v4l2_device.h"
#include "hal/v4l2/v4l2_format.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

std::string format_name(std::uint32_t fourcc) {
  for (const hal::V4l2Format& format : hal::kV4l2Formats) {
    if (format.fourcc == fourcc) return std::string(format.name);
  }
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(fourcc >> shift & 0x7fU);
  return text;
}

hal::CameraControl control_entry(const v4l2_query_ext_ctrl& control) {
  hal::CameraControl entry{.name = hal::control_variable(control.name),
                           .minimum = control.minimum,
                           .maximum = control.maximum,
                           .step = static_cast<std::int64_t>(control.step),
                           .default_value = control.default_value,
                           .state = {},
                           .values = {}};
  if ((control.flags & V4L2_CTRL_FLAG_INACTIVE) != 0) entry.state = "inactive";
  if ((control.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0) entry.state = "read only";
  return entry;
}

/// The links to each device node, in udev's folders of stable names.
std::map<fs::path, std::vector<std::string>> stable_paths() {
  std::map<fs::path, std::vector<std::string>> links;
  for (const char* folder : {"/dev/v4l/by-id", "/dev/v4l/by-path"}) {
    std::error_code error;
    for (const auto& link : fs::directory_iterator(folder, error)) {
      const fs::path node = fs::canonical(link.path(), error);
      if (!error) links[node].push_back(link.path().string());
    }
  }
  return links;
}

hal::CameraEntry camera_entry(const hal::V4l2Device& device) {
  hal::CameraEntry camera;
  camera.model = device.card();
  for (const std::uint32_t fourcc : device.formats()) {
    for (const std::string& size : device.sizes(fourcc)) {
      camera.modes.push_back({format_name(fourcc), size, {}});
    }
  }
  for (auto control = device.next_control(0); control; control = device.next_control(control->id)) {
    if (control->type == V4L2_CTRL_TYPE_CTRL_CLASS) continue;
    camera.controls.push_back(control_entry(*control));
  }
  return camera;
}

std::vector<hal::CameraEntry> v4l2_cameras() {
  std::vector<fs::path> nodes;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/dev", error)) {
    if (entry.path().filename().string().starts_with("video")) nodes.push_back(entry.path());
  }
  std::sort(nodes.begin(), nodes.end());
  auto links = stable_paths();
  std::vector<hal::CameraEntry> cameras;
  for (const fs::path& node : nodes) {
    const auto device = hal::V4l2Device::open(node.string());
    // One that is there but captures no pictures is no camera.
    if (!device && device.error().fault == hal::Fault::WrongFormat) continue;
    hal::CameraEntry camera = device ? camera_entry(*device) : hal::CameraEntry{};
    if (!device) camera.problem = device.error().detail;
    camera.back_end = "v4l2";
    camera.paths = std::move(links[node]);
    camera.paths.push_back(node.string());
    camera.id = camera.paths.front();
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

template <class Entry>
void append(std::vector<Entry>& all, std::vector<Entry> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

}  // namespace

hal::Inventory take_inventory() {
  hal::Inventory inventory;
  append(inventory.cameras, v4l2_cameras());
  return inventory;
}

}  // namespace orbwatch::app
