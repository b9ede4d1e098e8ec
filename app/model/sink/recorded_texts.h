// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orbwatch::app {

/// Texts in a recording besides its messages, so that it explains itself: the configuration that
/// was measured with.
struct RecordedTexts {
  /// Texts by their path below the folder of the configuration file: "site.toml",
  /// "recipes/weld.toml".
  std::map<std::string, std::string> files;
  std::vector<std::pair<std::string, std::string>> versions;  ///< by name, the program's own first
};

/// Name of the accepted alignments among them.
inline constexpr std::string_view kRecordedCalibration = "state/calibration.toml";
/// Folder of those that the configuration names by paths out of its folder, by their absolute path.
inline constexpr std::string_view kRecordedOutside = "outside";

}  // namespace orbwatch::app
