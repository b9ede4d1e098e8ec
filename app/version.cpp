#include "app/version.h"

#include "hal/libraries.h"

namespace orbwatch::app {

std::string version_text(const std::string& program) {
  std::string text = program + " " ORBWATCH_VERSION "\n";
  for (const auto& [name, version] : hal::library_versions()) {
    text.append(name).append(" ").append(version).append("\n");
  }
  return text;
}

}  // namespace orbwatch::app
