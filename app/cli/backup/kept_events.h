// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/cli/archive/frame_stream.h"
#include "app/cli/backup/manifest.h"
#include "app/cli/backup/placement.h"
#include "app/ports/recorder/events/event_folder.h"
#include "proc/image/result.h"

/// Kept events of the recorder in a backup: a frame of a tar with events/NAME/FILE, event by event
/// in the order of the manifest. They may be large, so they are never in memory as a whole.
namespace orbwatch::app::cli::backup {

/// Finished events that are kept (pinned), the oldest first. Error: as EventFolder::list().
Result<std::vector<recorder::StoredEvent>> kept_events(const std::filesystem::path& recordings);

/// Their entries in a manifest.
std::vector<ManifestEvent> manifest_events(std::span<const recorder::StoredEvent> events);

/// A folder of recordings.
struct EventPlace {
  std::filesystem::path recordings;  ///< empty: the configuration has none
  std::uint64_t reserve = 0;         ///< bytes of its disk that remain free
};

/// Error: the disk of a folder has no room for as many bytes as events have, and for a reserve.
Result<> check_room(const std::vector<ManifestEvent>& events, const std::filesystem::path& folder,
                    std::uint64_t reserve);

/// Writes the frame. Errors: a file that cannot be read or changes meanwhile; of the sink.
Result<> write_events(std::span<const recorder::StoredEvent> events, FrameWriter::Sink sink);

/// Checks a list of any origin. Error: names that are not those of events, in order and once each.
Result<> check_events(const std::vector<ManifestEvent>& events);

/// The events that are not there yet, of a list that check_events() accepts.
std::vector<ManifestEvent> missing_events(const std::vector<ManifestEvent>& events,
                                          const EventPlace& place);

/// Restores the events of such a list from a frame of any origin, which next() has begun; those
/// that are there stay as they are. Each appears as a whole or not at all, and belongs to the owner
/// of the folder. Errors: no room; damaged, or not the events of the manifest; of the disk. Those
/// before the error are restored.
Result<> place_events(FrameReader& frames, const std::vector<ManifestEvent>& events,
                      const EventPlace& place, DiskChanges& disk);

}  // namespace orbwatch::app::cli::backup
