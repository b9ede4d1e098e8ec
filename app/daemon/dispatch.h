#pragma once

#include <functional>

#include "app/commands.h"
#include "app/daemon/lines.h"
#include "app/pipeline/pipeline.h"
#include "app/snapshot/snapshot_sink.h"

namespace orbwatch::app {

/// Those who carry commands out.
struct Receivers {
  Pipeline& pipeline;
  Lines& lines;
  SnapshotSink* snapshots;        ///< null: no folder for them is configured
  std::function<void()> restart;  ///< asks for it and returns
};

/// Takes a command that check() let pass to the one that carries it out. Thread-safe, does not
/// wait.
CommandResult dispatch(const Command& command, const Receivers& receivers);

}  // namespace orbwatch::app
