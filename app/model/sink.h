#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/alarm_notice.h"
#include "app/model/appliance_notice.h"
#include "app/model/command.h"
#include "app/model/interface_metric.h"
#include "app/model/interface_table.h"
#include "app/model/measured_recipe.h"
#include "app/model/picture_needs.h"
#include "app/model/program.h"
#include "app/model/status.h"
#include "app/model/status_report.h"
#include "app/model/view.h"
#include "hal/sync/frame_set.h"
#include "hal/thread/shared_threads.h"
#include "proc/image/pixel_format.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// One camera of a view, and how that shows it if it has one channel.
struct PublishedSource {
  std::string camera;
  std::string colour_map;
  std::array<double, 2> range{};  ///< first and last colour, degC or % of full scale
  bool is_radiometric = false;    ///< degC
};

/// How a view is offered to the outside.
struct PublishedView {
  PixelFormat encoding = PixelFormat::Rgb;  ///< or Bgr or Grey
  bool measured = true;                     ///< it has a plane that is measured
  optics::ViewSpec spec{};                  ///< as configured
  /// Of kind Ball: where its first camera's picture of the ball shows the room; else null.
  std::shared_ptr<const optics::ViewProjection> ball = nullptr;
  bool is_own_picture = false;  ///< a display view of kind Ball, of one camera
  bool mixes = false;           ///< a display view whose sources are blended by weight
  std::vector<PublishedSource> sources{};
};

/// A camera's own picture as it is offered to the outside.
struct PublishedCamera {
  PixelFormat encoding = PixelFormat::Rgb;   ///< or Bgr or Grey
  std::optional<optics::Intrinsics> lens{};  ///< of that picture; nullopt: not calibrated
};

class AlignmentSource;
class CommandRecord;
class Fleet;

/// What every sink is made with, besides its own settings.
struct SinkContext {
  StatusNames names;
  std::vector<PublishedView> views;      ///< by place in names.views
  std::vector<PublishedCamera> cameras;  ///< by place in names.cameras
  optics::Ball ball;                     ///< machine frame, mm
  optics::SceneProxy scene;              ///< around it
  CommandHandler handler;
  std::shared_ptr<CommandRecord> record;           ///< of the commands that go to `handler`
  std::shared_ptr<hal::SharedThreads> background;  ///< for encoders
  std::filesystem::path state_folder;              ///< of what must outlast a restart
  AlignmentSource* alignment = nullptr;            ///< outlives the sinks' run; null: none
  Program program;                                 ///< around the appliance
  std::vector<MeasuredRecipe> recipes;             ///< what is measured
  /// What all sinks show of themselves, on any thread while they run; empty: nothing.
  std::function<std::vector<InterfaceTable>()> tables = nullptr;
  /// And what all count, under the same rule.
  std::function<std::vector<InterfaceMetric>()> metrics = nullptr;
  PageAddress page{};                      ///< of the appliance, as configured
  std::shared_ptr<Fleet> fleet = nullptr;  ///< who is heard over DDS; null: nobody
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
