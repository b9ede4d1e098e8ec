// SPDX-License-Identifier: Apache-2.0
#include "hal/module/module_camera.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "hal/module/load_module.h"
#include "hal/module/module_list.h"

namespace orbwatch::hal {
namespace {

/// Replaces a camera whose module cannot be used.
class AbsentCamera : public Camera {
 public:
  AbsentCamera(CameraInfo info, std::string reason)
      : Camera(std::move(info)), reason_(std::move(reason)) {}
  ~AbsentCamera() override { stop(); }

 protected:
  Result<StreamFormat> do_configure(const StreamRequest&) override { return fail(reason_); }
  /// Never called: the camera was not configured.
  void run(const std::stop_token&) override {}

 private:
  std::string reason_;
};

bool is_installed(std::string_view back_end) {
  std::error_code error;
  return std::filesystem::exists(module_file(back_end), error);
}

CameraEntry problem_of(std::string_view back_end, std::string problem) {
  CameraEntry entry;
  entry.back_end = back_end;
  entry.problem = std::move(problem);
  return entry;
}

}  // namespace

std::unique_ptr<Camera> make_module_camera(std::string_view back_end, const void* settings,
                                           const CameraContext& context) {
  const auto module = module_of(back_end);
  if (module) return (*module)->make_camera(settings, context);
  return std::make_unique<AbsentCamera>(CameraInfo{context.name, "unknown", std::string(back_end)},
                                        module.error().message);
}

std::vector<CameraEntry> list_module_cameras(std::string_view back_end) {
  if (!is_installed(back_end)) return {};
  const auto module = module_of(back_end);
  if (!module) return {problem_of(back_end, module.error().message)};
  return (*module)->list_cameras();
}

std::vector<CameraEntry> list_module_cameras() {
  std::vector<CameraEntry> all;
  for (const std::string_view back_end : kModuleBackEnds) {
    std::ranges::move(list_module_cameras(back_end), std::back_inserter(all));
  }
  return all;
}

std::vector<std::pair<std::string, std::string>> module_versions() {
  std::vector<std::pair<std::string, std::string>> versions;
  versions.reserve(kModuleBackEnds.size() + 1);
  for (const std::string_view back_end : kModuleBackEnds) {
    std::string version = "not installed";
    if (is_installed(back_end)) {
      const auto module = module_of(back_end);
      version = module ? (*module)->library_version() : module.error().message;
    }
    versions.emplace_back(back_end, std::move(version));
  }
  versions.emplace_back(kVideoModule, is_installed(kVideoModule) ? "installed" : "not installed");
  return versions;
}

}  // namespace orbwatch::hal
