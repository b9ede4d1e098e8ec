// SPDX-License-Identifier: Apache-2.0
#include "hal/module/load_module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <string>
#include <system_error>

namespace orbwatch::hal {
namespace {

namespace fs = std::filesystem;

std::string package_of(std::string_view back_end) {
  return "orbwatch-camera-" + std::string(back_end);
}

std::string other_version(const fs::path& file, std::string_view back_end,
                          const std::string& difference) {
  return file.string() + ": " + difference + "; install " + package_of(back_end) +
         " of this program's version";
}

Result<> check(const CameraModule& module, const fs::path& file, std::string_view back_end) {
  if (module.interface_version != kCameraModuleInterface) {
    return fail(other_version(file, back_end,
                              "has module interface " + std::to_string(module.interface_version) +
                                  ", this program " + std::to_string(kCameraModuleInterface)));
  }
  if (module.build_id == nullptr || std::string_view(module.build_id) != ORBWATCH_MODULE_BUILD_ID) {
    return fail(other_version(file, back_end, "was built from other headers than this program"));
  }
  if (module.back_end != back_end) {
    return fail(file.string() + ": is the module of " + std::string(module.back_end) +
                "; install " + package_of(back_end));
  }
  return {};
}

/// Descriptor of a loaded module. The error owns its text: nothing of the library is referenced.
Result<const CameraModule*> module_in(void* library, const fs::path& file,
                                      std::string_view back_end) {
  const auto entry = reinterpret_cast<CameraModuleEntry>(::dlsym(library, kCameraModuleEntry));
  const CameraModule* const module = entry != nullptr ? entry() : nullptr;
  if (module == nullptr) return fail(file.string() + ": is not a camera module of orbwatch");
  return check(*module, file, back_end).map([module] { return module; });
}

}  // namespace

fs::path module_folder() {
  const char* const other = ::secure_getenv("ORBWATCH_MODULES");
  return other != nullptr && *other != '\0' ? other : ORBWATCH_MODULE_FOLDER;
}

fs::path module_file(std::string_view back_end) {
  return module_folder() / ("camera-" + std::string(back_end) + ".so");
}

std::string install_command(std::string_view back_end) {
  const std::string package = package_of(back_end);
  return "sudo apt install ./" + package + "_*.deb (of a bundle: sudo ./install " + package + ")";
}

Result<const CameraModule*> load_module(const fs::path& file, std::string_view back_end) {
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return fail("the module does not load: " + std::string(::dlerror()) + "; install " +
                package_of(back_end) + " of this system, or rebuild it on this computer by " +
                "platform/build-deb --module " + std::string(back_end));
  }
  auto module = module_in(library, file, back_end);
  // One that fits is never closed: its threads and objects may outlive every camera.
  if (!module) ::dlclose(library);
  return module;
}

Result<const CameraModule*> module_of(std::string_view back_end) {
  const fs::path file = module_file(back_end);
  std::error_code error;
  if (!fs::exists(file, error)) {
    return fail("the camera needs the module " + std::string(back_end) +
                ", which is not installed: " + install_command(back_end) + "; looked for " +
                file.string());
  }
  return load_module(file, back_end);
}

}  // namespace orbwatch::hal
