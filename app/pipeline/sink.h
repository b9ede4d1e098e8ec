#pragma once

#include "app/pipeline/status.h"
#include "app/pipeline/view.h"
#include "hal/frame_set.h"
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

  /// The cameras' own pictures, before the views made of them. Their buffers are the cameras': a
  /// sink that keeps many makes a camera lose frames.
  virtual void accept_frames(const hal::FrameSet& /*set*/) {}
  virtual void accept(const ViewPtr& view) = 0;
  /// Called after the views of the same frame set, and at least ten times a second without frames.
  virtual void accept(const Status& status) = 0;

  /// What happened to an alarm, before the status that shows it. Newest-wins does not do here: a
  /// sink that passes notices on keeps a queue.
  virtual void note(const AlarmNotice& /*notice*/) {}
};

}  // namespace orbwatch::app
