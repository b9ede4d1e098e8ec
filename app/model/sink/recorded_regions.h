// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::app {

/// A measured region in the whole picture of a camera that it was measured in.
struct RecordedRegion {
  std::string name, camera;
  std::vector<std::vector<optics::Vec2>> lines;  ///< pixels; the outline may have gaps
};

/// A recipe of a recording.
struct RecordedRecipe {
  std::uint16_t number = 0;
  std::vector<RecordedRegion> regions;
};

/// Reads the recipes of a recording from the configuration in it, by the alignments that were in
/// force. Error: the configuration is not in it, or is refused. Reentrant; waits for the disk.
using RecordedRegionsReader =
    std::function<Result<std::vector<RecordedRecipe>>(const std::filesystem::path& recording)>;

}  // namespace orbwatch::app
