// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/export/export_steps.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Writes the folder of an event as the new ZIP file `output`: event.mcap and states.csv of the
/// range, summary.json, and trigger.jpg if there is one. They are made beside `output` first.
/// Errors: those of copy_range(), write_state_table() and ZipWriter; cancelled.
Result<> write_event_zip(const std::filesystem::path& event, const StampRange& range,
                         const std::filesystem::path& output, const ExportSteps& steps);

}  // namespace orbwatch::app::recorder
