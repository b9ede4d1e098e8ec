// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/fault.h"
#include "hal/frame/buffer_count.h"
#include "hal/frame/buffer_pool.h"
#include "hal/frame/frame.h"
#include "hal/frame/returned_buffers.h"
#include "hal/genicam/device/aravis.h"
#include "hal/genicam/format/negotiation.h"
#include "hal/thread/bounded_queue.h"

namespace orbwatch::hal {

/// A frame in a buffer that Aravis fills. Its memory stays while the frame is held.
struct GenicamFrame : FrameBuffer {
  explicit GenicamFrame(std::size_t bytes);

  OwnedObject<ArvBuffer> buffer;  ///< Aravis' buffer of this memory; its user data is this frame
};

/// Streaming camera. Its end stops the camera; held frames stay valid. Aravis receives on a thread
/// of its own; all calls of this class come from the camera's thread, except wake().
class GenicamStream {
 public:
  /// A filled buffer, whole or not.
  struct Captured {
    std::shared_ptr<GenicamFrame> frame;
    ArvBufferStatus status;
    std::optional<std::uint64_t> id;  ///< nullopt: its first packet was lost, and its stamp with it
    std::chrono::nanoseconds stamp;   ///< time by the camera's clock
    TimePoint arrival;  ///< arrival of the first of its packets that came; now, if unknown
  };

  /// Makes `buffers` and starts the camera, whose format is already negotiated.
  static DeviceResult<std::unique_ptr<GenicamStream>> start(ArvCamera* camera,
                                                            const GenicamStreamFormat& format,
                                                            std::size_t buffers);
  GenicamStream(const GenicamStream&) = delete;
  GenicamStream& operator=(const GenicamStream&) = delete;
  ~GenicamStream();

  /// Waits for the next frame; nullopt after wake() or at `deadline`. Queues returned buffers.
  /// Fault: the control of the camera was lost.
  DeviceResult<std::optional<Captured>> next(TimePoint deadline);

  /// Counts of this stream.
  LinkCounts link_counts() const;

  /// True when frames in use hold all buffers: there is none to fill.
  bool is_starved() const { return queued_ == 0; }

  /// Ends a wait in next(). Thread-safe.
  void wake() { events_->returned.wake(); }

  /// Marks the camera as unresponsive: the destructor does not try to stop it.
  void give_up() { is_lost_ = true; }

 private:
  /// Events from Aravis' threads; outlives the stream for as long as frames are held.
  struct Events {
    ReturnedBuffers returned;
    /// GigE Vision: moments at which Aravis received a first packet of the frames that take() has
    /// not returned yet.
    BoundedQueue<TimePoint, kMaxBuffers> begun;
    std::atomic<bool> control_lost = false;
  };

  GenicamStream(ArvCamera* camera, std::string id) : camera_(camera), id_(std::move(id)) {}

  void make_buffers(std::size_t bytes, std::size_t count);
  void queue(std::size_t index);
  std::optional<Captured> take();
  tl::unexpected<FaultReport> failed(const std::string& reason) const;

  static void on_stream_event(void* events, ArvStreamCallbackType type, ArvBuffer* buffer);
  static void on_control_lost(ArvDevice* device, void* share);

  ArvCamera* camera_;
  std::string id_;
  std::shared_ptr<Events> events_ = std::make_shared<Events>();
  std::optional<BufferPool<GenicamFrame>> pool_;
  std::vector<GenicamFrame*> frames_;  ///< frames of the pool, by index
  std::size_t queued_ = 0;
  OwnedObject<ArvStream> stream_;
  gulong control_handler_ = 0;
  bool is_started_ = false;
  bool is_lost_ = false;
};

/// Arrival, on the steady clock, of the packet with a system time (ns since 1970, as Aravis reports
/// it); `now` if the time is unknown or not plausible.
TimePoint arrival_of(std::uint64_t system_time, TimePoint now);

}  // namespace orbwatch::hal
