// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>

#include "app/ports/web/history/figure_history.h"
#include "hal/clock.h"
#include "hal/synchronised_clock.h"
#include "proc/image/result.h"

/// The history of figures over a restart, in a file: a line of JSON with the end of the steps (ns
/// by hal::Clock with the boot's id, and ns of UTC), their number, and the figures of each
/// component; then the lowest and the highest value of each step as floats of this computer. All
/// wait for the disk.
namespace orbwatch::app::web {

/// Replaces the file, atomically and readable by its owner only. Error: it cannot be written.
Result<> write_figures(const std::filesystem::path& file, const FigureHistory& history);

/// Continues `history`, which is new, with the file's steps, if there is one whose end is not
/// before all steps. `is_utc_certain`: the clock follows a time server; needed for a file from
/// before this boot. Error: it cannot be read, is damaged, ends in the future, or its age is
/// unknown.
Result<> resume_figures(const std::filesystem::path& file, FigureHistory& history,
                        bool is_utc_certain = hal::is_clock_synchronised());

}  // namespace orbwatch::app::web
