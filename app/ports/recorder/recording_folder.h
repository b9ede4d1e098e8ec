// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

#include "app/ports/recorder/recorder_settings.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// A recording in the folder.
struct Recording {
  std::filesystem::path file;
  std::uint64_t bytes = 0;
};

/// The folder of recordings, kept within its limits; other files in it are not touched. The folder
/// is the truth, there is no index beside it. Thread-bound; waits for the disk.
class RecordingFolder {
 public:
  explicit RecordingFolder(const RecorderSettings& settings) : settings_(settings) {}

  /// Creates the folder and finishes recordings that an earlier run did not end; what cannot be
  /// finished is logged and stays. Error: the folder.
  Result<> prepare();

  /// Recordings, the oldest first by their names.
  Result<std::vector<Recording>> list() const;

  /// Name for a recording that begins at `utc`: log-20261128T092200Z.mcap, with a number behind it
  /// if there is one already, as after the clock was set back.
  std::filesystem::path name_for(std::chrono::system_clock::time_point utc) const;

  /// Deletes the oldest recordings except `current` until the limits hold; returns their number.
  /// Errors: the folder; the disk has less than the reserve although there is none to delete.
  Result<int> make_room(const std::filesystem::path& current) const;

 private:
  const RecorderSettings settings_;
  std::set<std::filesystem::path> unfinished_;  ///< those that cannot be finished, logged once
};

}  // namespace orbwatch::app::recorder
