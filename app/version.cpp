#include "app/version.h"

#include "hal/libraries.h"
#include "hal/module/module_camera.h"

namespace orbwatch::app {

std::string version_text(const std::string& program) {
  std::string text = program + " " ORBWATCH_VERSION "\n";
  for (const auto& libraries : {hal::library_versions(), hal::module_versions()}) {
    for (const auto& [name, version] : libraries) {
      text.append(name).append(" ").append(version).append("\n");
    }
  }
  return text;
}

}  // namespace orbwatch::app
