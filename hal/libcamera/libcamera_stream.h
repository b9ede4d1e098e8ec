// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/camera.h>
#include <libcamera/framebuffer_allocator.h>

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hal/clock.h"
#include "hal/frame/buffer_pool.h"
#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/controls/libcamera_controls.h"
#include "hal/libcamera/format/camera_configuration.h"
#include "hal/libcamera/libcamera_frame.h"

namespace orbwatch::hal {

/// Events for the camera's thread from libcamera's thread and from those that release frames.
/// Outlives the stream for as long as frames are held. Holds one entry per request, so it cannot
/// overflow. Thread-safe with one waiter; senders never wait for it.
class CaptureEvents {
 public:
  static constexpr std::size_t kMaxRequests = kMaxBuffers;

  /// Events since the last wait().
  struct Pending {
    std::array<std::uint8_t, kMaxRequests> completed{};  ///< request numbers, oldest first
    std::size_t completed_count = 0;
    std::uint32_t returned = 0;  ///< one bit per buffer whose last frame was released
    bool removed = false;        ///< the camera was unplugged
    bool woken = false;
  };

  /// Adds a completed request; each is queued at most once.
  void complete(std::size_t request);
  void return_buffer(std::size_t buffer);
  void remove_camera();
  /// Ends a wait.
  void wake();

  /// Waits for events until `deadline` and takes them.
  Pending wait(TimePoint deadline);

 private:
  template <class Change>
  void post(const Change& change);

  std::mutex mutex_;
  std::condition_variable changed_;
  Pending pending_;
};

/// Streaming camera: one request per buffer, queued again when the last frame of its buffer is
/// released. Its end stops and releases the camera; held frames stay valid. Thread-bound except
/// wake().
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
  /// the next request. The buffers lie in memory of the first of `sources` that has enough, else in
  /// that of the camera's driver.
  static DeviceResult<std::unique_ptr<LibcameraStream>> start(
      AcquiredCamera camera, const NegotiatedConfiguration& negotiated, ControlSettings& controls,
      const std::vector<DmaBufferSource>& sources);
  LibcameraStream(const LibcameraStream&) = delete;
  LibcameraStream& operator=(const LibcameraStream&) = delete;
  ~LibcameraStream();

  /// Waits for events until `deadline`: queues returned buffers and calls `on_captured` for each
  /// completed request. Returns their number. Faults: the camera was removed, refuses a request or
  /// cancelled one.
  DeviceResult<std::size_t> wait(TimePoint deadline, const OnCaptured& on_captured);

  /// Ends the stream like the destructor. False: the device vanished unnoticed by libcamera. Then
  /// the owner must never destroy this object: see has_lost_its_nodes().
  bool end();

  /// True when frames in use hold all buffers: the camera has none to fill.
  bool is_starved() const { return queued_ == 0; }

  /// Text for the log: number of buffers, and their memory.
  std::string memory_text() const { return to_text(memory_, frames_.size(), requested_); }

  /// Ends a wait(). Thread-safe.
  void wake() { events_->wake(); }

 private:
  LibcameraStream(AcquiredCamera camera, ControlSettings& controls);

  Result<> make_buffers(const NegotiatedConfiguration& negotiated,
                        const std::vector<DmaBufferSource>& sources);
  Result<> map_buffers(const NegotiatedConfiguration& negotiated);
  /// The camera's buffers, or those that replace them.
  const std::vector<std::unique_ptr<libcamera::FrameBuffer>>& buffers() const {
    return imported_.empty() ? allocator_.buffers(stream_) : imported_;
  }
  Result<> import_buffers(const DmaBufferSource& source);
  Result<> make_requests();
  DeviceResult<> run(double frame_rate);
  DeviceResult<> queue(std::size_t number);
  DeviceResult<> queue_returned(std::uint32_t returned);
  DeviceResult<Captured> take(std::size_t number);
  tl::unexpected<FaultReport> failed(const std::string& action, int error) const;

  // Declared in order of dependence: requests are destroyed first, the camera last.
  AcquiredCamera camera_;
  ControlSettings& controls_;
  std::shared_ptr<CaptureEvents> events_ = std::make_shared<CaptureEvents>();
  RemovalWatch removal_;
  libcamera::FrameBufferAllocator allocator_;
  libcamera::Stream* stream_ = nullptr;
  /// Empty: the allocator's buffers are used.
  std::vector<std::unique_ptr<libcamera::FrameBuffer>> imported_;
  FrameMemory memory_;
  std::size_t requested_ = 0;  ///< number of buffers
  std::optional<BufferPool<LibcameraFrame>> pool_;
  std::vector<const LibcameraFrame*> frames_;                  ///< frames of the pool, by buffer
  std::vector<std::unique_ptr<libcamera::Request>> requests_;  ///< one per buffer
  std::size_t queued_ = 0;
  bool removed_ = false;  ///< reported by libcamera
  bool ended_ = false;
};

}  // namespace orbwatch::hal
