// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/device/found_camera.h"

#include <mutex>
#include <optional>
#include <utility>

#include "hal/genicam/device/aravis.h"
#include "hal/genicam/device/gige_identity.h"

namespace orbwatch::hal {
namespace {

constexpr const char* kGigeVision = "GigEVision";

std::string to_text(const std::vector<FoundCamera>& cameras) {
  std::string text;
  for (const FoundCamera& camera : cameras) {
    text += (text.empty() ? "\"" : ", \"") + camera.id + "\" at " + camera.address;
  }
  return text.empty() ? "none" : text;
}

bool is_named(const FoundCamera& camera, const std::string& wanted) {
  return camera.id == wanted || camera.serial == wanted || camera.address == wanted ||
         (!camera.name.empty() && camera.name == wanted);
}

/// Searches a camera at its address.
std::optional<FoundCamera> at_address(const std::string& address) {
  const auto identity = read_gige_identity(address);
  if (!identity) return std::nullopt;
  return FoundCamera{address,        identity->model, identity->serial,
                     identity->name, address,         kGigeVision};
}

}  // namespace

std::vector<FoundCamera> find_cameras() {
  // Aravis has one list per process, whose texts are valid until it is made again.
  static std::mutex mutex;
  std::vector<FoundCamera> cameras;
  {
    const std::lock_guard lock(mutex);
    arv_update_device_list();
    for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
      cameras.push_back({text_of(arv_get_device_id(i)), text_of(arv_get_device_model(i)),
                         text_of(arv_get_device_serial_nbr(i)), "",
                         text_of(arv_get_device_address(i)), text_of(arv_get_device_protocol(i))});
    }
  }
  for (FoundCamera& camera : cameras) {
    if (!camera.is_gige()) continue;
    if (auto identity = read_gige_identity(camera.address)) camera.name = std::move(identity->name);
  }
  return cameras;
}

Result<FoundCamera> choose_found_camera(const std::vector<FoundCamera>& cameras,
                                        const std::string& wanted) {
  std::vector<FoundCamera> fitting;
  for (const FoundCamera& camera : cameras) {
    if (is_named(camera, wanted)) fitting.push_back(camera);
  }
  if (fitting.size() == 1) return fitting.front();
  const std::string who = "genicam: camera \"" + wanted + "\"";
  if (fitting.empty()) return fail(who + " does not answer; there are: " + to_text(cameras));
  return fail(who + " could be any of " + to_text(fitting));
}

Result<FoundCamera> find_camera_again(const std::string& wanted, const FoundCamera& known) {
  if (is_ip_address(wanted)) {
    if (auto camera = at_address(wanted)) return *camera;
    return fail("genicam: no camera answers at " + wanted);
  }
  if (known.is_gige()) {
    const auto same = at_address(known.address);
    if (same && same->serial == known.serial && same->model == known.model) return known;
  }
  return choose_found_camera(find_cameras(), wanted);
}

}  // namespace orbwatch::hal
