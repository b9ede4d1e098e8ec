// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "app/cli/progress.h"
#include "app/daemon/replay/replay.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

struct ReplaySettings {
  std::filesystem::path recording;
  std::string recipe;  ///< file in place of the recorded recipe, FILE or NUMBER=FILE; empty: none
  bool compares = false;
  double tolerance = 0;          ///< see daemon::Comparison
  std::optional<double> settle;  ///< s at the start that are not compared; none: daemon::kSettle
};

struct ReplayFigures {
  std::size_t sets = 0;              ///< measured frame sets
  std::size_t without_pictures = 0;  ///< frame sets that were recorded without
  daemon::ComparisonCounts compared;
};

/// Measures all frame sets of a recording again, with the configuration in it, and writes the
/// measurements as CSV; or, if it compares, what differs from the recorded ones. Errors: of the
/// recording and its configuration; no frame set with pictures; `is_cancelled`.
Result<ReplayFigures> run_replay(const ReplaySettings& settings, std::ostream& csv,
                                 Progress& progress, const std::atomic<bool>& is_cancelled);

}  // namespace orbwatch::app::cli
