// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/cli/archive/frame_stream.h"
#include "app/cli/backup/manifest.h"
#include "app/ports/recorder/events/event_folder.h"
#include "proc/image/result.h"

/// Kept events of the recorder, for a backup: for each, in the order of the manifest, a frame with
/// a checksum of a tar with events/NAME/FILE. They may be large, so they are never in memory as a
/// whole.
namespace orbwatch::app::cli::backup {

/// Those of listed events that are finished and kept (pinned); `left_out` receives a line about
/// each that has no recording. An event that was removed meanwhile is left out. Error: an event
/// whose folder cannot be read.
Result<std::vector<recorder::StoredEvent>> kept_events(std::vector<recorder::StoredEvent> events,
                                                       std::vector<std::string>& left_out);

/// Their entries in a manifest.
std::vector<ManifestEvent> manifest_events(std::span<const recorder::StoredEvent> events);

/// Writes the frames of events, whose entries in the manifest are `stated`. Errors: a file that
/// cannot be read; an event that has changed since; of the sink.
Result<> write_events(std::span<const recorder::StoredEvent> events,
                      const std::vector<ManifestEvent>& stated, const FrameWriter::Sink& sink);

}  // namespace orbwatch::app::cli::backup
