#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "app/model/alarm_notice.h"
#include "app/model/interface_metric.h"
#include "app/model/interface_table.h"
#include "app/model/picture_needs.h"
#include "app/model/status.h"
#include "app/model/view.h"
#include "hal/sync/frame_set.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// A translator to the outside. The pipeline hands over views and status; a sink that is slow loses
/// them, counted, and never delays the pipeline.
/// Thread rule: start and stop on the main thread; accept on the pipeline's thread, where it must
/// return at once (no lock held across work, no system call that may wait).
class Sink {
 public:
  virtual ~Sink() = default;

  /// Opens what is needed (sockets, participants) and starts the sink's own thread. After an error
  /// it is called again; views and status may come before.
  virtual Result<> start() = 0;
  /// False: what it serves is missing although it started, the network for example. On any thread.
  virtual bool works() const { return true; }
  /// Processor time of its threads since the start. On any thread.
  virtual std::chrono::nanoseconds cpu_time() const { return {}; }
  /// What it shows of itself at this moment. On any thread.
  virtual std::vector<InterfaceTable> tables() const { return {}; }
  /// Its counters at this moment, for metrics. On any thread.
  virtual std::vector<InterfaceMetric> metrics() const { return {}; }
  /// Ends the thread and closes everything; repeating it does nothing.
  virtual void stop() = 0;

  /// The cameras' own pictures, before the views made of them. Their buffers are the cameras': all
  /// sinks together keep hal::kFrameReaders of a camera, each for one conversion and the wait for
  /// it.
  virtual void accept_frames(const hal::FrameSet& /*set*/) {}
  /// The forms in which the sink needs the next picture of a view, asked before it is made. The
  /// picture that it accepts then serves these, and what other sinks need; if nobody needs one, the
  /// view comes without. On the pipeline's thread, as accept.
  virtual PictureNeeds needs(std::size_t /*view*/, hal::TimePoint /*stamp*/) { return {}; }
  /// How many views it can hold besides the one that it is being given: there are buffers for
  /// that many. A sink that holds more loses views, counted as skipped. On the main thread, before
  /// the run.
  virtual KeptViews keeps() const { return {}; }
  virtual void accept(const ViewPtr& view) = 0;
  /// Called after the views of the same frame set, and at least ten times a second without frames.
  virtual void accept(const Status& status) = 0;

  /// Called before the status that shows it. Each notice counts: a sink that forwards them keeps a
  /// bounded queue.
  virtual void accept_event(const AlarmNotice& /*notice*/) {}
};

}  // namespace orbwatch::app
