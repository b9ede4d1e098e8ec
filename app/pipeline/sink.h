#pragma once

#include "app/pipeline/status.h"
#include "app/pipeline/view.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// A translator to the outside. The pipeline hands over views and status; a sink that is slow loses
/// them, counted, and never delays the pipeline.
/// Thread rule: start and stop on the main thread; accept on the pipeline's thread, where it must
/// return at once (no lock held across work, no system call that may wait).
class Sink {
 public:
  virtual ~Sink() = default;

  /// Opens what is needed (sockets, participants) and starts the sink's own thread.
  virtual Result<> start() = 0;
  /// Ends the thread and closes everything; repeating it does nothing.
  virtual void stop() = 0;

  virtual void accept(const ViewPtr& view) = 0;
  /// Called after the views of the same frame set, and at least ten times a second without frames.
  virtual void accept(const Status& status) = 0;
};

}  // namespace orbwatch::app
