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

/// Kept events of the recorder in a backup: for each, in the order of the manifest, a frame with a
/// checksum of a tar with events/NAME/FILE. They may be large, so they are never in memory as a
/// whole.
namespace orbwatch::app::cli::backup {

/// Finished events that are kept (pinned), the oldest first; `left_out` receives a line about each
/// that has no recording. Errors: as EventFolder::list(); an event whose folder cannot be read.
Result<std::vector<recorder::StoredEvent>> kept_events(const std::filesystem::path& recordings,
                                                       std::vector<std::string>& left_out);

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

/// Writes the frames of events, whose entries in the manifest are `stated`. Errors: a file that
/// cannot be read; an event that has changed since; of the sink.
Result<> write_events(std::span<const recorder::StoredEvent> events,
                      const std::vector<ManifestEvent>& stated, const FrameWriter::Sink& sink);

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
/// as_owner_of(). Errors: also of the disk. Those before the error are added.
Result<> place_events(FrameReader& frames, const std::vector<ManifestEvent>& events,
                      const EventPlace& place, DiskChanges& disk);

}  // namespace orbwatch::app::cli::backup
