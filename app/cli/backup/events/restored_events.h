// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/cli/archive/frame_stream.h"
#include "app/cli/backup/manifest.h"
#include "app/cli/backup/placement.h"
#include "proc/image/result.h"

/// Events from a backup, in the form that kept_events.h describes.
namespace orbwatch::app::cli::backup {

/// A folder of recordings.
struct EventPlace {
  std::filesystem::path recordings;  ///< empty: the configuration has none
  std::uint64_t reserve = 0;         ///< bytes of its disk that remain free
};

/// Checks a list of any origin. Errors: names that are not those of events, in order and once
/// each; more than 10,000.
Result<> check_events(const std::vector<ManifestEvent>& events);

/// The events that are not there yet, of a list that check_events() accepts.
std::vector<ManifestEvent> missing_events(const std::vector<ManifestEvent>& events,
                                          const EventPlace& place);

/// Reads the frames of such a list of any origin, the first of which next() has begun. Errors: no
/// room for those that are missing; damaged, or not the events of the list.
Result<> check_frames(FrameReader& frames, const std::vector<ManifestEvent>& events,
                      const EventPlace& place);

/// The same, and adds the missing events; those that are there stay as they are. Each appears when
/// its checksum is right, as a whole or not at all. Has the rights of the owner of recordings, see
/// as_owner_of(). Errors: also of the disk; another call adds events there. Those before the error
/// are added.
Result<> place_events(FrameReader& frames, const std::vector<ManifestEvent>& events,
                      const EventPlace& place, DiskChanges& disk);

}  // namespace orbwatch::app::cli::backup
