// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/frame/buffer_count.h"
#include "hal/frame/buffer_pool.h"
#include "hal/frame/frame.h"
#include "hal/frame/frame_memory.h"
#include "hal/frame/returned_buffers.h"
#include "hal/v4l2/device/v4l2_device.h"
#include "hal/v4l2/format/v4l2_format.h"

namespace orbwatch::hal {

/// A driver's time stamp on the steady clock and what it marks.
struct FrameStamp {
  TimePoint moment;
  StampSource source = StampSource::Arrival;
};

/// The driver's time stamp, or `arrival` when it belongs to another clock or is not plausible.
/// Drivers declare whether they stamp the start of the exposure (USB cameras do) or the end of the
/// frame.
FrameStamp frame_stamp(const FilledBuffer& buffer, TimePoint arrival);

/// A frame in a device's buffer, which stays mapped while the frame is held.
struct DriverFrame : FrameBuffer {
  explicit DriverFrame(std::vector<BufferMemory> buffer);

  /// For the camera's thread: call before the first read of the device's data, and before the
  /// device writes again. Error: as DmaBuffer.
  Result<> begin_read();
  Result<> end_read();

  std::vector<BufferMemory> memory_planes;  ///< memory planes in the format's order

 private:
  Result<> synchronise(Result<> (DmaBuffer::*moment)() const);

  bool is_read_ = false;
};

/// Device that streams into mapped buffers, its own or imported ones. Its end stops the device and
/// closes it; frames that are still held stay valid. Thread-bound except wake().
class V4l2Stream {
 public:
  struct Captured {
    std::shared_ptr<DriverFrame> frame;  ///< its picture is set, if the driver's memory is one
    FilledBuffer buffer;                 ///< the driver's description of it

    /// The samples in one memory plane; empty when the driver's offset or size is invalid.
    std::span<const std::byte> samples(std::size_t memory) const;
  };

  /// Makes `buffers`, or the number that the driver chooses, and starts the device, whose format is
  /// already negotiated. They lie in memory of the first of `sources` with which the device starts,
  /// else in the driver's own.
  static DeviceResult<std::unique_ptr<V4l2Stream>> start(
      V4l2Device device, const NegotiatedFormat& format, std::size_t buffers,
      const std::vector<DmaBufferSource>& sources);
  V4l2Stream(const V4l2Stream&) = delete;
  V4l2Stream& operator=(const V4l2Stream&) = delete;
  ~V4l2Stream();

  /// Waits for the next frame; nullopt after wake() or at `deadline`. Queues returned buffers.
  DeviceResult<std::optional<Captured>> next(TimePoint deadline);

  /// True when frames in use hold all buffers: the device has none to fill.
  bool is_starved() const { return queued_ == 0; }

  /// Text for the log: number of buffers, and their memory.
  std::string memory_text() const { return to_text(memory_, frames_.size(), requested_); }

  /// Ends a wait in next(). Thread-safe.
  void wake() { returned_->wake(); }

 private:
  V4l2Stream(V4l2Device device, const NegotiatedFormat& format, std::size_t buffers)
      : device_(std::move(device)),
        format_(format),
        requested_(buffers),
        returned_(std::make_shared<ReturnedBuffers>()) {}

  DeviceResult<> start_in_best_memory(const std::vector<DmaBufferSource>& sources);
  DeviceResult<> start_in(const DmaBufferSource& source);
  static Result<std::vector<BufferMemory>> allocate(const DmaBufferSource& source,
                                                    const DriverFormat& format);
  DeviceResult<> start_in_own_memory();
  DeviceResult<> start_with(std::vector<std::unique_ptr<DriverFrame>> frames);
  void reset();
  DeviceResult<> check_memory(const DriverFrame& frame) const;
  DeviceResult<> queue_returned();
  DeviceResult<> queue(std::uint32_t index);
  DeviceResult<std::optional<Captured>> take();

  tl::unexpected<FaultReport> failed(const std::string& message) const;

  V4l2Device device_;
  NegotiatedFormat format_;
  const std::size_t requested_;  ///< number of buffers
  FrameMemory memory_;
  std::shared_ptr<ReturnedBuffers> returned_;
  std::optional<BufferPool<DriverFrame>> pool_;
  std::vector<DriverFrame*> frames_;  ///< frames of the pool, by index
  std::uint32_t queued_ = 0;          ///< one bit for each buffer that the device has
};

}  // namespace orbwatch::hal
