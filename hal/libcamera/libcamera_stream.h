#pragma once

#include <libcamera/camera.h>
#include <libcamera/framebuffer_allocator.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hal/frame/buffer_pool.h"
#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/capture_events.h"
#include "hal/libcamera/controls/control_settings.h"
#include "hal/libcamera/format/camera_configuration.h"
#include "hal/libcamera/libcamera_frame.h"

namespace orbwatch::hal {

/// A streaming camera: one request per buffer, queued again when the last frame of its buffer is
/// released. Its end stops and releases the camera; held frames stay valid.
/// Thread-bound but for wake().
class LibcameraStream {
 public:
  /// A completed request. Its frame's picture is set, its memory readable.
  struct Captured {
    std::shared_ptr<LibcameraFrame> frame;
    const libcamera::ControlList& metadata;
    const libcamera::FrameMetadata& buffer;
  };
  using OnCaptured = std::function<void(const Captured&)>;

  /// Makes the buffers and starts the configured camera with `controls`; later settings are part of
  /// the next request.
  static DeviceResult<std::unique_ptr<LibcameraStream>> start(
      AcquiredCamera camera, const NegotiatedConfiguration& negotiated, ControlSettings& controls);
  LibcameraStream(const LibcameraStream&) = delete;
  LibcameraStream& operator=(const LibcameraStream&) = delete;
  ~LibcameraStream();

  /// Waits for events until `deadline`: queues returned buffers and calls `on_captured` for each
  /// completed request. Returns their number. Faults: the camera was removed, refuses a request or
  /// cancelled one.
  DeviceResult<std::size_t> wait(TimePoint deadline, const OnCaptured& on_captured);

  /// Ends the stream, as the destructor does. False: the device vanished unnoticed by libcamera.
  /// Then the owner must never destroy this object: see has_lost_its_nodes().
  bool end();

  /// True when frames in use hold all buffers: the camera has none to fill.
  bool is_starved() const { return queued_ == 0; }

  /// Ends a wait(). Thread-safe.
  void wake() { events_->wake(); }

 private:
  LibcameraStream(AcquiredCamera camera, ControlSettings& controls);

  Result<> make_buffers(const NegotiatedConfiguration& negotiated);
  Result<> make_requests(libcamera::Stream* stream);
  DeviceResult<> run(double frame_rate);
  DeviceResult<> queue(std::size_t number);
  DeviceResult<> queue_returned(std::uint32_t returned);
  DeviceResult<Captured> take(std::size_t number);
  tl::unexpected<FaultReport> failed(const std::string& action, int error) const;

  // In order of dependence: requests are destroyed first, the camera last.
  AcquiredCamera camera_;
  ControlSettings& controls_;
  std::shared_ptr<CaptureEvents> events_ = std::make_shared<CaptureEvents>();
  RemovalWatch removal_;
  libcamera::FrameBufferAllocator allocator_;
  libcamera::Stream* stream_ = nullptr;
  std::optional<BufferPool<LibcameraFrame>> pool_;
  std::vector<const LibcameraFrame*> frames_;                  ///< the pool's, by buffer
  std::vector<std::unique_ptr<libcamera::Request>> requests_;  ///< by buffer
  std::size_t queued_ = 0;
  bool removed_ = false;  ///< reported by libcamera
  bool ended_ = false;
};

}  // namespace orbwatch::hal
