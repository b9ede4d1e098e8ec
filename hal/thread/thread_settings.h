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
             "Lines, capture, pipeline and workers run before all other programs (SCHED_FIFO 48, "
             "44, 40, 40), where the kernel allows it: LimitRTPRIO=48 of the unit");
  v.optional("lock_memory", threads.lock_memory,
             "No page that was used is swapped out, where the kernel allows it: "
             "LimitMEMLOCK=infinity of the unit");
  v.optional("cores", threads.cores, Range::between(0, 1023),
             "Numbers of the cores that capture, pipeline and workers keep to, as isolcpus= "
             "counts them; none: all");
  v.optional("background", threads.background, Range::between(1, 8),
             "Threads that encode and write pictures and compile views that are pointed: more, if "
             "one does not keep up and there are cores to spare");
}

}  // namespace orbwatch::hal
