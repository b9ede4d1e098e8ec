#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/buffer_pool.h"
#include "hal/frame.h"
#include "hal/v4l2/v4l2_device.h"
#include "hal/v4l2/v4l2_format.h"

namespace orbwatch::hal {

/// A frame in a driver's memory, which stays mapped for as long as the frame is held.
struct DriverFrame : FrameBuffer {
  explicit DriverFrame(std::vector<BufferMemory> driver_memory);

  /// For the camera's thread: before the first look at what the device wrote, and before the device
  /// writes again. Error: as DmaBuffer.
  Result<> begin_read();
  Result<> end_read();

  std::vector<BufferMemory> stretches;  ///< in the order of the format's

 private:
  Result<> synchronise(Result<> (DmaBuffer::*moment)() const);

  bool is_read_ = false;
};

/// The door bell of a stream: buffers whose last frame was released wait here until the camera's
/// thread, which alone talks to the device, queues them again. It outlives the stream for as long
/// as frames are held, so a late release rings where nobody listens. Thread-safe, lock-free.
class ReturnedBuffers {
 public:
  static constexpr std::size_t kMaxBuffers = 32;

  ReturnedBuffers();

  bool is_open() const { return bell_.is_open(); }
  int descriptor() const { return bell_.get(); }  ///< readable after put() or ring()
  void put(std::size_t index);
  void ring();
  /// One bit per returned buffer; silences the bell.
  std::uint32_t take();

 private:
  FileDescriptor bell_;
  std::atomic<std::uint32_t> returned_{0};
};

/// A device that streams into mapped buffers. Its end stops the device and closes it; frames that
/// are still held stay valid. Thread-bound but for ring().
class V4l2Stream {
 public:
  struct Captured {
    std::shared_ptr<DriverFrame> frame;  ///< its picture is set, if the driver's memory is one
    FilledBuffer buffer;                 ///< the driver's words about it

    /// What is in one stretch of memory: empty when the driver says it is where it cannot be.
    std::span<const std::byte> samples(std::size_t memory) const;
  };

  /// Makes the buffers and starts the device, whose format was agreed on.
  static DeviceResult<std::unique_ptr<V4l2Stream>> start(V4l2Device device,
                                                         const V4l2Agreement& agreement);
  V4l2Stream(const V4l2Stream&) = delete;
  V4l2Stream& operator=(const V4l2Stream&) = delete;
  ~V4l2Stream();

  /// Waits for the next frame; nothing when the bell rang or `deadline` passed. Queues the buffers
  /// that were returned.
  DeviceResult<std::optional<Captured>> next(TimePoint deadline);

  /// True when frames in use hold all buffers: the device has none to fill.
  bool is_starved() const { return queued_ == 0; }

  /// Ends a wait in next(). Thread-safe.
  void ring() { returned_->ring(); }

 private:
  V4l2Stream(V4l2Device device, const V4l2Agreement& agreement)
      : device_(std::move(device)),
        agreement_(agreement),
        returned_(std::make_shared<ReturnedBuffers>()) {}

  DeviceResult<> make_buffers();
  DeviceResult<> check_size(const DriverFrame& frame) const;
  DeviceResult<> queue_returned();
  DeviceResult<> queue(std::uint32_t index);
  DeviceResult<std::optional<Captured>> take();

  tl::unexpected<FaultReport> failed(const std::string& message) const;

  V4l2Device device_;
  V4l2Agreement agreement_;
  std::shared_ptr<ReturnedBuffers> returned_;
  std::optional<BufferPool<DriverFrame>> pool_;
  std::vector<DriverFrame*> frames_;  ///< the pool's, by index
  std::uint32_t queued_ = 0;          ///< one bit per buffer that the device has
};

}  // namespace orbwatch::hal
