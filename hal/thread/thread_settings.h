// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Kernel scheduling of the frame path: capture, pipeline, workers and lines.
struct ThreadSettings {
  bool realtime = true;
  bool lock_memory = true;
  std::vector<int> cores;  ///< cores of the frame path; none: all
  int background = 1;      ///< threads that encode pictures and compile views
};

template <class Visitor>
void visit(Visitor& v, ThreadSettings& threads) {
  v.optional("realtime", threads.realtime,
             "Real-time scheduling (SCHED_FIFO) of lines, capture, pipeline and workers with "
             "priorities 48, 44, 40, 40; needs LimitRTPRIO=48 in the unit");
  v.optional(
      "lock_memory", threads.lock_memory,
      "Lock memory, so that no used page is swapped out; needs LimitMEMLOCK=infinity in the unit");
  v.optional("cores", threads.cores, Range::between(0, 1023),
             "Cores for capture, pipeline and workers, numbered as in isolcpus=; []: all");
  v.optional("background", threads.background, Range::between(1, 8),
             "Threads that encode and write pictures and compile pointed views; set more if one "
             "does not keep up and cores are idle");
}

}  // namespace orbwatch::hal
