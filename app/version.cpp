// SPDX-License-Identifier: Apache-2.0
#include "app/version.h"

#include "hal/libraries.h"
#include "hal/module/module_camera.h"

namespace orbwatch::app {

std::vector<std::pair<std::string, std::string>> versions(const std::string& program) {
  std::vector<std::pair<std::string, std::string>> all{{program, ORBWATCH_VERSION}};
  for (const auto& libraries : {hal::library_versions(), hal::module_versions()}) {
    for (const auto& [name, version] : libraries) all.emplace_back(name, version);
  }
  return all;
}

std::string version_text(const std::string& program) {
  std::string text;
  for (const auto& [name, version] : versions(program)) {
    text.append(name).append(" ").append(version).append("\n");
  }
  return text;
}

}  // namespace orbwatch::app
