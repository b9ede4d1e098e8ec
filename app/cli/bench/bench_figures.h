#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/cli/bench/thread_loads.h"
#include "app/model/status.h"

namespace orbwatch::app {

/// Median and the value that 99 of 100 do not exceed.
struct Percentiles {
  double p50 = 0;
  double p99 = 0;
};

/// Nearest rank; 0 without samples. Changes their order.
Percentiles percentiles(std::vector<float>& samples);

/// What a run of the appliance took.
struct BenchFigures {
  struct Camera {
    std::string name;
    std::string format;  ///< with size and rate
    std::uint64_t dropped = 0;
  };
  struct ViewFigures {
    std::string name;
    int width = 0;
    int height = 0;
    std::uint64_t published = 0;
    std::uint64_t skipped = 0;
    Percentiles latency;  ///< exposure start to hand-over, ms
  };

  double seconds = 0;
  double wanted_rate = 0;  ///< frame sets per second
  std::uint64_t frame_sets = 0;
  std::uint64_t overruns = 0;
  std::size_t cores = 0;                      ///< that the program may use
  bool realtime = false;                      ///< as SystemStatus
  bool memory_locked = false;                 ///< as SystemStatus
  Percentiles busy;                           ///< SystemStatus::busy_ms
  std::array<Percentiles, kStages> stages{};  ///< StageStatus::cpu_ms
  std::array<double, kStages> means{};        ///< the same, ms
  std::vector<Camera> cameras;
  std::vector<ViewFigures> views;
  std::vector<ThreadLoad> threads;
  MemoryFigures memory;
};

/// Whether the computer does the work at the wanted rate.
struct Verdict {
  bool fits = false;
  double used = 0;       ///< share of what the computer can do; its scarcest part counts
  std::string sentence;  ///< one line: the margin, or what is too much and what to lower first
};

/// Two things are scarce: the time of the pipeline's thread, one frame set after the other, and
/// that of all cores. Both are judged by processor time, which other programs do not inflate; frame
/// sets that were late nevertheless are a verdict, too. Reentrant.
Verdict judge(const BenchFigures& figures);

/// For people, and as JSON (RFC 8259). Reentrant.
std::string bench_text(const BenchFigures& figures, const Verdict& verdict);
std::string bench_json(const BenchFigures& figures, const Verdict& verdict);

}  // namespace orbwatch::app
