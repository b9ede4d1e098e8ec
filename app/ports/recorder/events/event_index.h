// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/ports/recorder/events/event_folder.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// The events of a folder in memory. The folder stays the truth: it is read at first, and again
/// once names in it changed, whichever program did that; only events whose own folder changed are
/// read. Until then an update costs one stat() for the folder and for each event that is being
/// recorded, whose size is that at the last reading. Thread-bound; waits for the disk.
class EventIndex {
 public:
  explicit EventIndex(const std::filesystem::path& recordings) : folder_(recordings) {}

  /// Follows the folder. True: the events differ from those before. Error: the folder.
  Result<bool> update();

  /// Events of the last update, the oldest first by their names.
  const std::vector<StoredEvent>& events() const { return events_; }
  /// Those of them that are being recorded, or whose recorder ended early.
  const std::vector<StoredEvent>& unfinished() const { return unfinished_; }

 private:
  const EventFolder folder_;
  std::optional<std::filesystem::file_time_type> changed_;
  std::vector<StoredEvent> events_, unfinished_;
};

}  // namespace orbwatch::app::recorder
