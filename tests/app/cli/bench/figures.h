// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/cli/bench/bench_figures.h"
#include "proc/signals/signals.h"

namespace orbwatch::app::cli {

/// Figures of 30 frame sets per second for ten seconds on 4 cores: the pipeline's thread is busy
/// for half of the period, all cores for a quarter.
inline BenchFigures some_figures() {
  constexpr double kPeriod = 1000.0 / 30;  // ms
  BenchFigures figures;
  figures.seconds = 10;
  figures.wanted_rate = 30;
  figures.frame_sets = 300;
  figures.cores = 4;
  figures.realtime = true;
  figures.busy = {0.4 * kPeriod, 0.5 * kPeriod};
  figures.means = {0, 0.2 * kPeriod, 0.7 * kPeriod, 0.05 * kPeriod, 0.05 * kPeriod, 0};
  for (std::size_t i = 0; i < kStages; ++i) {
    figures.stages[i] = {figures.means[i], 1.5 * figures.means[i]};
  }
  figures.cameras = {{"front", "nv12 1920x1080 at 30", 2}};
  figures.views = {{"small", 320, 240, 300, 0, {5, 6}}, {"wide", 1024, 512, 299, 1, {7, 9}}};
  figures.threads = {{1, "pipeline", std::chrono::seconds(4)},
                     {2, "worker 1", std::chrono::seconds(3)}};
  figures.memory = {120, 130, 90, 20, 10, signals::kNotValid};
  return figures;
}

}  // namespace orbwatch::app::cli
