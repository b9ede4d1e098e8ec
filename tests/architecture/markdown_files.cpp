// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/markdown_files.h"

#include <string>

namespace orbwatch::tests {

std::vector<std::filesystem::path> markdown_files() {
  namespace fs = std::filesystem;
  std::vector<fs::path> found;
  for (auto it = fs::recursive_directory_iterator(ORBWATCH_SOURCE_DIR);
       it != fs::recursive_directory_iterator(); ++it) {
    const std::string name = it->path().filename().string();
    if (it->is_directory() && (name == "build" || name == "out" || name.starts_with("."))) {
      it.disable_recursion_pending();
    } else if (it->path().extension() == ".md") {
      found.push_back(it->path());
    }
  }
  return found;
}

}  // namespace orbwatch::tests
