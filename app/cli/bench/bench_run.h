// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "app/cli/bench/bench_figures.h"
#include "app/cli/progress.h"
#include "app/files/resolve.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

struct BenchSettings {
  double seconds = 10;
  std::chrono::milliseconds patience{10000};  ///< time until the first frame set
};

/// Progress and cancellation of a run.
struct BenchWatch {
  const std::atomic<bool>& cancelled;
  Progress& progress;
};

/// Runs the appliance of a site like orbwatchd and returns its cost. It warms up for a second
/// first. `notes`, by camera, are for people. Errors: those of Appliance, a camera that cannot be
/// opened, no frame within the patience, `cancelled` before a frame set was measured.
Result<BenchFigures> run_bench(const files::Resolved& site, const std::vector<std::string>& notes,
                               const BenchSettings& settings, const BenchWatch& watch);

}  // namespace orbwatch::app::cli
