// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hal/sync/frame_matcher.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::pipeline {

/// Frame budget and workers.
struct PipelineSettings {
  hal::Clock::duration deadline{0};  ///< for a frame set; 0: the pacing camera's frame period
  hal::SyncSettings sync;
  int workers =
      -1;  ///< threads besides the pipeline's own; -1: derived from the cores, see visit()
};

template <class Visitor>
void visit(Visitor& v, PipelineSettings& pipeline) {
  v.optional("deadline_ms", pipeline.deadline, Milliseconds{Range::between(0, 60000)},
             "Deadline of one frame set; 0: the frame period of the camera that sets the pace");
  v.optional("sync_window_ms", pipeline.sync.window, Milliseconds{Range::between(0, 10000)},
             "Largest difference of exposure starts in a set");
  v.optional("sync_max_wait_ms", pipeline.sync.max_wait, Milliseconds{Range::between(0, 10000)},
             "Longest wait of the first camera's frame for those of the others");
  v.optional("workers", pipeline.workers, Range::between(-1, 64),
             "Threads besides the pipeline's own; -1: workers and pipeline together use all cores "
             "but one, or all of `threads.cores`");
}

}  // namespace orbwatch::app::pipeline
