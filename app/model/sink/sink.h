// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "app/model/sink/interface_metric.h"
#include "app/model/sink/interface_table.h"
#include "app/model/sink/picture_needs.h"
#include "app/model/sink/view.h"
#include "app/model/status/alarm_notice.h"
#include "app/model/status/status.h"
#include "hal/camera.h"
#include "hal/sync/frame_set.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// An output interface. The pipeline passes views and status to it; a slow sink loses some of them,
/// counted, and never delays the pipeline.
/// Thread rule: start and stop on the main thread; accept on the pipeline's thread, where it must
/// return at once (no lock held across work, no system call that may wait).
class Sink {
 public:
  virtual ~Sink() = default;

  /// Opens what is needed (sockets, participants) and starts the sink's own thread. After an error
  /// it is called again; views and status may come before.
  virtual Result<> start() = 0;
  /// Returns false if the sink has started but cannot serve, for example without a network. On any
  /// thread.
  virtual bool works() const { return true; }
  /// Processor time of its threads since the start. On any thread.
  virtual std::chrono::nanoseconds cpu_time() const { return {}; }
  /// Tables of the sink's present state. On any thread.
  virtual std::vector<InterfaceTable> tables() const { return {}; }
  /// Its counters at this moment, for metrics. On any thread.
  virtual std::vector<InterfaceMetric> metrics() const { return {}; }
  /// Ends the thread and closes everything; repeating it does nothing.
  virtual void stop() = 0;

  /// Called before the first frame set of a camera that was absent at the start and delivers
  /// another format than was expected of it. On the pipeline's thread.
  virtual void accept_format(std::size_t /*camera*/, const hal::StreamFormat& /*format*/) {}
  /// The cameras' own pictures, before the views made of them. The cameras own their buffers: all
  /// sinks together keep hal::kFrameReaders buffers of a camera, each until one conversion is done.
  virtual void accept_frames(const hal::FrameSet& /*set*/) {}
  /// Returns the forms in which the sink needs the next picture of a view; called before the
  /// picture is rendered. The accepted picture then serves these needs and those of other sinks; if
  /// no sink needs one, the view has no picture. On the pipeline's thread, like accept().
  virtual PictureNeeds needs(std::size_t /*view*/, hal::TimePoint /*stamp*/) { return {}; }
  /// Number of views that the sink may hold besides the one being passed: as many buffers are
  /// allocated. A sink that holds more loses views, counted as skipped. On the main thread, before
  /// the run.
  virtual KeptViews keeps() const { return {}; }
  virtual void accept(const ViewPtr& view) = 0;
  /// Called before the views of the same frame set, and at least ten times a second: again without
  /// frames, and between views that take long.
  virtual void accept(const Status& status) = 0;

  /// Called before the status that shows it. Each notice counts: a sink that forwards them keeps a
  /// bounded queue.
  virtual void accept_event(const AlarmNotice& /*notice*/) {}
};

}  // namespace orbwatch::app
