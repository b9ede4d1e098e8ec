// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/cli_result.h"
#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/export/export_range.h"

namespace orbwatch::app::cli {

/// Options of `orbwatch events export`.
struct EventExport {
  std::filesystem::path output;  ///< its ending is the kind
  std::string camera;            ///< for pictures; may be empty if the event has one alone
  recorder::ExportRange range;
  bool draws = false;     ///< values of each frame set, into the pictures of a video
  bool replaces = false;  ///< an existing file
};

/// Writes the file, whole or not at all; shows progress; Ctrl-C cancels. Returns a line about it.
/// Errors: another ending; an event that is being recorded or was not completed; those of the kind.
CliResult<std::string> export_event(const recorder::StoredEvent& event, const EventExport& o);

}  // namespace orbwatch::app::cli
