// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/cli/bench/thread_loads.h"
#include "app/model/status/status.h"

namespace orbwatch::app::cli {

/// Median and 99th percentile.
struct Percentiles {
  double p50 = 0;
  double p99 = 0;
};

/// Percentiles by nearest rank; 0 without samples. Changes their order.
Percentiles percentiles(std::vector<float>& samples);

/// Cost of a run of the appliance.
struct BenchFigures {
  struct Camera {
    std::string name;
    std::string format;  ///< pixel format, size and rate
    std::uint64_t dropped = 0;
  };
  struct ViewFigures {
    std::string name;
    int width = 0;
    int height = 0;
    std::uint64_t published = 0;
    std::uint64_t skipped = 0;
    Percentiles latency;  ///< time from exposure start to hand-over, ms
  };

  double seconds = 0;
  double wanted_rate = 0;  ///< frame sets per second
  std::uint64_t frame_sets = 0;
  std::uint64_t overruns = 0;
  std::size_t cores = 0;                      ///< cores that the program may use
  bool realtime = false;                      ///< see SystemStatus
  bool memory_locked = false;                 ///< see SystemStatus
  Percentiles busy;                           ///< SystemStatus::busy_ms
  std::array<Percentiles, kStages> stages{};  ///< StageStatus::cpu_ms
  std::array<double, kStages> means{};        ///< means of StageStatus::cpu_ms
  std::vector<Camera> cameras;
  std::vector<ViewFigures> views;
  std::vector<ThreadLoad> threads;
  MemoryFigures memory;
};

/// Ability of the computer to do the work at the wanted rate.
struct Verdict {
  bool fits = false;
  double used = 0;       ///< share of the computer's capacity; its scarcest part counts
  std::string sentence;  ///< one line: the margin, or the part that is overloaded and the first
                         ///< setting to lower
};

/// Judges the two limits: the time of the pipeline's thread, one frame set after the other, and
/// that of all cores. Both are judged by processor time, which other programs do not inflate; frame
/// sets that were late nevertheless also make a verdict. Reentrant.
Verdict judge(const BenchFigures& figures);

/// Figures and verdict as text for people, and as JSON (RFC 8259). Reentrant.
std::string bench_text(const BenchFigures& figures, const Verdict& verdict);
std::string bench_json(const BenchFigures& figures, const Verdict& verdict);

}  // namespace orbwatch::app::cli
