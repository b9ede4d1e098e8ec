#pragma once

#include <memory>
#include <vector>

#include "app/model/command.h"
#include "app/model/status.h"
#include "app/model/status_report.h"
#include "app/model/view.h"
#include "hal/sync/frame_set.h"
#include "proc/image/pixel_format.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// How a view is offered to the outside.
struct PublishedView {
  PixelFormat encoding = PixelFormat::Rgb;  ///< or Bgr or Grey
  bool perspective = true;                  ///< a pinhole camera describes it
  bool measured = true;                     ///< it has a plane that is measured
};

class CommandRecord;

/// What every sink is made with, besides its own settings.
struct SinkContext {
  StatusNames names;
  std::vector<PublishedView> views;           ///< by place in names.views
  std::vector<PixelFormat> camera_encodings;  ///< Rgb, Bgr or Grey, by place in names.cameras
  CommandHandler handler;
  std::shared_ptr<CommandRecord> record;  ///< of the commands that go to `handler`
};

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
  /// Ends the thread and closes everything; repeating it does nothing.
  virtual void stop() = 0;

  /// The cameras' own pictures, before the views made of them. Their buffers are the cameras': all
  /// sinks together keep hal::kFrameReaders of a camera, each for one conversion.
  virtual void accept_frames(const hal::FrameSet& /*set*/) {}
  virtual void accept(const ViewPtr& view) = 0;
  /// Called after the views of the same frame set, and at least ten times a second without frames.
  virtual void accept(const Status& status) = 0;

  /// Called before the status that shows it. Each notice counts: a sink that forwards them keeps a
  /// bounded queue.
  virtual void accept_event(const AlarmNotice& /*notice*/) {}
};

}  // namespace orbwatch::app
