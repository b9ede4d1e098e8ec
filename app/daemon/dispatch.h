// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/alignment/alignment_desk.h"
#include "app/model/command/command.h"
#include "app/model/command/restart.h"
#include "app/pipeline/pipeline.h"
#include "app/ports/lines/lines.h"
#include "app/ports/recorder/recorder_sink.h"
#include "app/ports/snapshot/snapshot_sink.h"
#include "app/watch/camera_watch.h"

namespace orbwatch::app::daemon {

/// What executes commands.
struct Receivers {
  pipeline::Pipeline& pipeline;
  Lines& lines;
  SnapshotSink* snapshots;  ///< null: no folder for them is configured
  RecorderSink* recorder;   ///< null: nothing is recorded
  CameraWatch& watch;
  AlignmentDesk& alignment;
  Restart restart;
};

/// Executes a command that passed check(): the one list of handlers. Thread-safe. Waits for nobody
/// but in restart and in accepting an alignment, which check the files before.
CommandResult dispatch(const Command& command, const Receivers& receivers);

}  // namespace orbwatch::app::daemon
