// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/control_delay.h"
#include "hal/damage_watch.h"
#include "hal/fault.h"
#include "hal/frame/buffer_count.h"
#include "hal/frame/exposure_start.h"
#include "hal/frame/frame.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Identity of a camera.
struct CameraInfo {
  std::string id;        ///< stable across restarts: a path, a folder, a simulated camera's name
  std::string model;     ///< name that the device reports
  std::string back_end;  ///< "simulated", "replay", "v4l2", ...
};

/// Limit for any camera, frames per second.
inline constexpr int kMaxFrameRate = 1000;

/// Facts about a camera from the site, passed to every back-end's make_camera().
struct CameraContext {
  std::string name;             ///< camera's name in the site's files
  double frame_rate = 0;        ///< per second; 0: the camera's own
  double kelvin_per_count = 0;  ///< 0: not radiometric
  std::vector<ScriptedFault> faults;
  double kelvin_offset = 0;  ///< temperature of a count of 0, K
};

/// The requested stream. Zero leaves the choice to the camera.
struct StreamRequest {
  int width = 0;
  int height = 0;
  double frame_rate = 0;  ///< frames per second (GenICam AcquisitionFrameRate)
  /// Frames in use at once (GenICam StreamBufferCountManual): 1..kMaxBuffers. A driver may make
  /// fewer.
  std::size_t buffers = kFreeRunningBuffers;
  /// A camera that sends JPEG keeps the data of each frame beside its pixels: FrameBuffer::jpeg.
  bool keeps_jpeg = false;
  /// Only frames of triggers are used. A V4L2 camera that was left waiting for triggers keeps doing
  /// so; without triggers it is set to run freely.
  bool is_triggered = false;
};

/// Scale that a camera states for its counts; a count of 0 is 0 K.
struct CountScale {
  double kelvin_per_count = 0;  ///< 0: they are not proportional to temperature
  std::string stated_by;  ///< source: the feature and its value, such as "IRFormat is Radiometric"
};

/// The negotiated stream. A requested size or format is honoured or refused.
struct StreamFormat {
  PixelFormat format = PixelFormat::Grey;
  ColourSpace colour_space;
  int width = 0;
  int height = 0;
  double frame_rate = 0;
  double kelvin_per_count = 0;  ///< scale of a radiometric camera, once its controls are set
  double kelvin_offset = 0;     ///< temperature of its count 0, K
  bool has_jpeg = false;        ///< its frames have FrameBuffer::jpeg
};

/// Counts of imperfect frames that a camera reported since start().
struct FrameQuality {
  std::uint64_t damaged = 0;  ///< withheld frames: see Camera::discard()
  std::uint64_t flawed = 0;   ///< delivered frames: see FrameStatus
};

/// Losses on the link to a camera since the camera was made; zeros if nothing counts them.
struct LinkCounts {
  std::uint64_t missing_packets = 0;  ///< packets that never came: their frames are damaged
  std::uint64_t resent_packets = 0;   ///< packets that came when they were requested again
  std::uint64_t underruns = 0;        ///< packets for which there was no buffer
};

/// A source of frames: real, replayed or simulated. This class is the shell that guards the
/// invariants; back-ends implement the protected part.
///
/// Life: configure, start, stop, in this order; start and stop may be repeated, and configure again
/// while stopped. Frames and faults arrive on the camera's own thread, one at a time.
/// A damaged frame costs itself and its trigger; many are a fault: see DamageWatch.
/// Thread rule: configure, start and stop are thread-bound (one owner); stop may also be called
/// inside a callback; trigger, set, count_scale, quality, link_counts and capture_time are
/// thread-safe.
class Camera {
 public:
  using OnFrame = std::function<void(Frame)>;
  using OnFault = std::function<void(const FaultReport&)>;
  using Gate = std::function<bool(FrameMetadata&)>;
  using OnNotice = std::function<void(const std::string&)>;

  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;
  /// Every back-end's destructor calls stop() first: its thread uses the back-end's members.
  virtual ~Camera();

  const CameraInfo& info() const { return info_; }

  /// Opens the device and fixes size, format and rate. Errors: running, not found, not possible.
  Result<StreamFormat> configure(const StreamRequest& request);

  /// Called for each frame before it is forwarded, on the camera's thread: may complete the
  /// metadata; false withholds the frame, which then counts as never exposed. Also called for each
  /// frame that is withheld already; see FrameStatus. Set while stopped.
  void set_gate(Gate gate) { gate_ = std::move(gate); }

  /// Facts about the time stamps from the site. Set while stopped.
  void set_stamps(const StampSettings& settings) { stamps_ = settings; }
  /// From now on a frame without a stamp of its own (StampSource::Arrival) counts as damaged, and
  /// many of them are the fault NoTimeStamps: its moment is not known well enough to assign it to a
  /// trigger or to a frame of another camera. Set while stopped.
  void require_stamps() { requires_stamps_ = true; }

  /// Called on the camera's thread, on each change, with a text that is worth a line in the log but
  /// is not a fault. Set while stopped; must not throw.
  void set_on_notice(OnNotice on_notice) { on_notice_ = std::move(on_notice); }

  /// Starts the camera's thread. `on_frame` and `on_fault` must return quickly and not throw.
  /// Errors: not configured, running already.
  Result<> start(OnFrame on_frame, OnFault on_fault);

  /// Ends the stream; no callback begins after it returns. Called inside a callback, it does not
  /// wait, and that callback is the last. Repeating it does nothing.
  void stop();

  /// GenICam TriggerSoftware: exposes one frame. Error: the camera has no software trigger.
  virtual Result<> trigger();

  FrameQuality quality() const { return {damaged_, flawed_}; }
  virtual LinkCounts link_counts() const { return {}; }

  /// Processor time of capture since the start; 0 for a camera that computes its own pictures,
  /// since a real camera does not have that work.
  std::chrono::nanoseconds capture_time() const {
    return role() == ThreadRole::Capture ? thread_.cpu_time() : std::chrono::nanoseconds(0);
  }

  /// Sets a control by name in its own unit. FrameMetadata::controls_as_of states from
  /// when it is in effect. While a DeviceCamera is unplugged the value is kept, and set when it
  /// reconnects; a refusal is then the fault Refused. Error: no such control, or out of range.
  Result<> set(std::string_view control, double value);

  /// Scale of the configured camera with its present controls; nullopt: the camera does not state
  /// one. Once started, it keeps this scale until it is configured again.
  virtual std::optional<CountScale> count_scale() const { return std::nullopt; }

  /// Addition to a message that the configured camera's format is not the expected one, such as ";
  /// its EXIF orientation turns its 640x480"; empty: nothing explains it.
  virtual std::string format_note() const { return {}; }

 protected:
  explicit Camera(CameraInfo info) : info_(std::move(info)) {}

  virtual Result<StreamFormat> do_configure(const StreamRequest& request) = 0;

  virtual Result<> do_set(std::string_view control, double value);
  /// Number of exposures that may begin after do_set() without its control.
  virtual std::size_t control_delay() const { return 0; }

  /// Role of the camera's thread; Service for a camera that computes its pictures.
  virtual ThreadRole role() const { return ThreadRole::Capture; }

  /// The camera's thread: delivers until `stop` is requested. Faults are reported, not thrown; the
  /// back-end reconnects by itself.
  virtual void run(const std::stop_token& stop) = 0;

  /// For run(): forwards an intact frame and ends a fault. Between many damaged frames the frame is
  /// withheld, and the fault lasts.
  void deliver(std::shared_ptr<FrameBuffer> frame);
  /// For run(): counts a damaged frame whose number and stamp at least are known. `detail` is the
  /// text of `fault`, which many damaged frames raise; the one that raises it determines both.
  void discard(FrameMetadata metadata, std::string detail, Fault fault = Fault::CorruptFrame);
  /// For run(): reports a fault when it differs from the last one reported.
  void report(Fault fault, std::string detail = {});
  /// For run(): the device is gone; until set_kept(), set() keeps values that cannot be set.
  void keep_controls() { keeps_controls_ = true; }
  /// For run(): the device is there again; sets the kept values. Error: the device refuses one.
  Result<> set_kept();
  /// For run(): reports a notice unless it equals the last one.
  void notify(const std::string& text);
  /// For run(): reports the fault, if any, that a script has for the exposure with this metadata.
  /// False: it has none.
  bool fails(const FaultScript& script, const FrameMetadata& metadata);
  /// True from start() until the next configure(): what a count means stays. Thread-safe.
  bool was_started() const { return was_started_; }
  /// For run(): waits until `moment`. False: the stop was requested.
  bool wait_until(TimePoint moment);
  /// For run(): waits for a wake(). False: the stop was requested.
  bool wait() { return thread_.wait(); }
  /// Callable on any thread.
  void wake() { thread_.wake(); }

 private:
  bool passes_gate(FrameMetadata& metadata);
  void announce(Fault fault, std::string detail);

  CameraInfo info_;
  bool configured_ = false;
  std::atomic<bool> was_started_ = false;
  std::mutex setting_;  ///< held while a control is set; run() waits for it only in set_kept()
  std::atomic<bool> keeps_controls_ = false;
  std::vector<std::pair<std::string, double>> kept_;  ///< guarded by setting_
  Gate gate_;
  StampSettings stamps_;
  bool requires_stamps_ = false;
  std::uint64_t withheld_ = 0;  ///< frames withheld by the gate since start
  DamageWatch damage_;
  ControlDelay control_delay_;
  std::atomic<std::uint64_t> damaged_ = 0;
  std::atomic<std::uint64_t> flawed_ = 0;
  OnFrame on_frame_;
  OnFault on_fault_;
  OnNotice on_notice_;
  Fault last_fault_ = Fault::None;
  std::string last_notice_;
  Thread thread_;
};

}  // namespace orbwatch::hal
