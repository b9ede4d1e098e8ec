// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace orbwatch::app {

/// Texts in a recording besides its messages, so that it explains itself: the configuration that
/// was measured with.
struct RecordedTexts {
  std::map<std::string, std::string> files;  ///< texts by name: "site.toml", "rig.toml"
  std::vector<std::pair<std::string, std::string>> versions;  ///< by name, the program's own first
};

}  // namespace orbwatch::app
