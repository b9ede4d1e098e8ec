#include "app/state/state_folder.h"

#include <cstdlib>
#include <string_view>

namespace orbwatch::app {

std::filesystem::path state_folder(const std::filesystem::path& configured) {
  if (!configured.empty()) return configured;
  const char* const folders = std::getenv("STATE_DIRECTORY");
  const std::string_view all = folders != nullptr ? folders : "";
  const std::string_view first = all.substr(0, all.find(':'));
  return first.empty() ? "/var/lib/orbwatch" : std::filesystem::path(first);
}

}  // namespace orbwatch::app
