// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/export/export_steps.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Writes the states of a range as CSV into the new file `output`: a row for each frame set, with
/// utc, utc_ns, frame_set, trigger, recipe, region.NAME.FIGURE and machine.FIGURE; empty: not
/// valid, or not in this set. Errors: those of RecordedStates; more columns than a table can have;
/// of the disk; cancelled.
Result<> write_state_table(const std::filesystem::path& recording, const StampRange& range,
                           const std::filesystem::path& output, const ExportSteps& steps);

}  // namespace orbwatch::app::recorder
