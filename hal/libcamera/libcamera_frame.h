// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/controls.h>
#include <libcamera/framebuffer.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal/frame/device_memory.h"
#include "hal/frame/frame.h"
#include "hal/frame/frame_memory.h"
#include "hal/libcamera/format/libcamera_format.h"

namespace orbwatch::hal {

/// A dma-buf of libcamera, mapped for reading.
struct MappedDmaBuffer {
  DmaBuffer file;
  MappedMemory memory;
};

/// Frame in libcamera's buffer, which stays mapped while the frame is held, also after its stream
/// has ended. Only the device writes to it.
struct LibcameraFrame : FrameBuffer {
  std::vector<MappedDmaBuffer> dma_buffers;

  /// Maps the planes of `buffer` and describes the picture in them. Errors: cannot be mapped, too
  /// small.
  static Result<std::unique_ptr<LibcameraFrame>> map(const libcamera::FrameBuffer& buffer,
                                                     const LibcameraFormat& format, int width,
                                                     int height, std::size_t stride);
  Result<> begin_read() const { return synchronise(&DmaBuffer::begin_read); }
  Result<> end_read() const { return synchronise(&DmaBuffer::end_read); }

 private:
  Result<> synchronise(Result<> (DmaBuffer::*moment)() const) const;
};

/// Makes a buffer in memory of `source` with the plane layout of `own`, a buffer that the camera
/// made. Error: it cannot be allocated.
Result<std::unique_ptr<libcamera::FrameBuffer>> make_buffer_like(const libcamera::FrameBuffer& own,
                                                                 const DmaBufferSource& source);

/// Readings of two of the kernel's clocks at one moment.
struct ClockReading {
  TimePoint steady;               ///< CLOCK_MONOTONIC
  std::chrono::nanoseconds boot;  ///< CLOCK_BOOTTIME, which includes suspend

  static ClockReading now();
};

/// A frame's stamp on the steady clock, or nullopt when it is in the future or a minute old.
/// libcamera documents CLOCK_BOOTTIME, but several pipelines forward their driver's
/// CLOCK_MONOTONIC. The two differ only after a suspend, and then boot stamps are in the future.
std::optional<TimePoint> to_steady(std::chrono::nanoseconds stamp, const ClockReading& arrival);

/// A frame's metadata from its request; the sequence stays 0. SensorTimestamp is treated as the
/// start of the readout: documented as the exposure of the first row, on a Raspberry Pi it is the
/// frame start that Unicam or CFE detects, the end of that row's exposure (raspberrypi/picamera2
/// 821), and it is not earlier on any other platform. Without it `buffer_stamp` (ns), the end of
/// the frame, is used; if that is not plausible, `arrival`.
FrameMetadata metadata_of(const libcamera::ControlList& request, std::uint64_t buffer_stamp,
                          const ClockReading& arrival);

}  // namespace orbwatch::hal
