#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "hal/fault.h"
#include "hal/frame.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Which camera this is.
struct CameraInfo {
  std::string id;        ///< stable across restarts: a path, a folder, a simulated camera's name
  std::string model;     ///< what the device calls itself
  std::string back_end;  ///< "simulated", "replay", "v4l2", ...
};

/// Of any camera, frames per second.
inline constexpr int kMaxFrameRate = 1000;

/// What the pipeline asks for. Zero leaves the choice to the camera.
struct StreamRequest {
  int width = 0;
  int height = 0;
  double frame_rate = 0;  ///< frames per second (GenICam AcquisitionFrameRate)
};

/// What the camera will deliver. A size or format that was asked for is honoured or refused.
struct StreamFormat {
  PixelFormat format = PixelFormat::Grey;
  ColourSpace colour_space;
  int width = 0;
  int height = 0;
  double frame_rate = 0;
};

/// A source of frames: real, replayed or simulated. This class is the shell that guards the rules;
/// back-ends implement the protected part.
///
/// Life: configure, start, stop, in this order; start and stop may be repeated, and configure again
/// while stopped. Frames and faults arrive on the camera's own thread, one at a time.
/// Thread rule: configure, start and stop are thread-bound (one owner); stop may also be called
/// inside a callback; trigger and set are thread-safe.
class Camera {
 public:
  using OnFrame = std::function<void(Frame)>;
  using OnFault = std::function<void(const FaultReport&)>;
  using Gate = std::function<bool(FrameMetadata&)>;

  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;
  /// Every back-end's destructor calls stop() first: its thread uses the back-end's members.
  virtual ~Camera();

  const CameraInfo& info() const { return info_; }

  /// Opens the device and fixes size, format and rate. Errors: running, not found, not possible.
  Result<StreamFormat> configure(const StreamRequest& request);

  /// Asked for each frame before it is handed on, on the camera's thread: may complete the
  /// metadata; false withholds the frame, which then counts as never exposed. Set while stopped.
  void set_gate(Gate gate) { gate_ = std::move(gate); }

  /// Starts the camera's thread. `on_frame` and `on_fault` must return quickly and not throw.
  /// Errors: not configured, running already.
  Result<> start(OnFrame on_frame, OnFault on_fault);

  /// Ends the stream; no callback comes after it returns, except when it is called inside one: then
  /// that callback is the last. Repeating it does nothing.
  void stop();

  /// GenICam TriggerSoftware: exposes one frame. Error: the camera has no software trigger.
  virtual Result<> trigger();

  /// Sets a control by name in its own unit. Error: no such control, or out of range.
  virtual Result<> set(std::string_view control, double value);

 protected:
  explicit Camera(CameraInfo info) : info_(std::move(info)) {}

  virtual Result<StreamFormat> do_configure(const StreamRequest& request) = 0;

  /// The camera's thread: delivers until `stop` is requested. Faults are reported, not thrown; the
  /// back-end tries to come back by itself.
  virtual void run(const std::stop_token& stop) = 0;

  /// For run(): hands a frame on.
  void deliver(std::shared_ptr<FrameBuffer> frame);
  /// For run(): reports a fault when it differs from the last one reported.
  void report(Fault fault, std::string detail = {});
  /// For run(): waits until `moment` or until stop is requested; false if it was.
  bool wait_until(const std::stop_token& stop, TimePoint moment);

 private:
  void join();

  CameraInfo info_;
  bool configured_ = false;
  Gate gate_;
  std::uint64_t withheld_ = 0;  ///< by the gate since start
  OnFrame on_frame_;
  OnFault on_fault_;
  Fault last_fault_ = Fault::None;
  std::mutex wait_mutex_;
  std::condition_variable_any wake_;
  std::stop_source stop_;
  std::atomic<std::thread::id> runner_;  ///< set by the camera's thread itself
  std::thread thread_;
};

}  // namespace orbwatch::hal
