#pragma once

#include <libcamera/camera.h>
#include <libcamera/framebuffer_allocator.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hal/buffer_pool.h"
#include "hal/libcamera/camera_configuration.h"
#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/capture_events.h"
#include "hal/libcamera/control_settings.h"
#include "hal/libcamera/libcamera_frame.h"

namespace orbwatch::hal {

/// A camera that streams: one request per buffer, queued again when the last frame of its buffer
/// is released. Its end stops and releases the camera; frames that are still held stay valid.
/// Thread-bound but for ring().
class LibcameraStream {
 public:
  /// A completed request. Its frame's picture is set, and the memory can be read.
  struct Captured {
    std::shared_ptr<LibcameraFrame> frame;
    const libcamera::ControlList& metadata;
    const libcamera::FrameMetadata& buffer;
  };
  using OnCaptured = std::function<void(const Captured&)>;

  /// Makes the buffers and starts the camera, which was configured as agreed, with `controls`; what
  /// is set later goes along with the next request.
  static DeviceResult<std::unique_ptr<LibcameraStream>> start(AcquiredCamera camera,
                                                              const LibcameraAgreement& agreed,
                                                              ControlSettings& controls);
  LibcameraStream(const LibcameraStream&) = delete;
  LibcameraStream& operator=(const LibcameraStream&) = delete;
  ~LibcameraStream();

  /// Waits until something happens or `deadline`: queues the buffers that were returned, and calls
  /// `on_captured` for each completed request. Returns how many there were. Faults: the camera was
  /// removed, refuses a request or cancelled one.
  DeviceResult<std::size_t> wait(TimePoint deadline, const OnCaptured& on_captured);

  /// Ends the stream, as the destructor does. False: the device went away behind libcamera's back.
  /// Whoever owns this object must then never destroy it: see has_lost_its_nodes().
  bool end();

  /// True when frames in use hold all buffers: the camera has none to fill.
  bool is_starved() const { return queued_ == 0; }

  /// Ends a wait(). Thread-safe.
  void ring() { events_->ring(); }

 private:
  LibcameraStream(AcquiredCamera camera, ControlSettings& controls);

  Result<> make_buffers(const LibcameraAgreement& agreed);
  Result<> make_requests(libcamera::Stream* stream);
  DeviceResult<> run(double frame_rate);
  DeviceResult<> queue(std::size_t number);
  DeviceResult<> queue_returned(std::uint32_t returned);
  DeviceResult<Captured> take(std::size_t number);
  tl::unexpected<FaultReport> failed(const std::string& action, int error) const;

  // In the order in which they are needed: requests go first, the camera last.
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
  bool removed_ = false;  ///< libcamera said so
  bool ended_ = false;
};

}  // namespace orbwatch::hal
