#pragma once

#include <libcamera/framebuffer.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "hal/frame/device_memory.h"
#include "hal/frame/frame.h"
#include "hal/libcamera/format/libcamera_format.h"

namespace orbwatch::hal {

/// A dma-buf of libcamera, mapped for reading.
struct MappedDmaBuffer {
  DmaBuffer file;
  MappedMemory memory;
};

/// A frame in libcamera's buffer, which stays mapped while the frame is held, also after its stream
/// has ended. Only the device writes to it.
struct LibcameraFrame : FrameBuffer {
  std::vector<MappedDmaBuffer> dma_buffers;

  /// Maps the planes of `buffer` and describes the picture in them. Errors: cannot be mapped, too
  /// small.
  static Result<std::unique_ptr<LibcameraFrame>> map(const libcamera::FrameBuffer& buffer,
                                                     const LibcameraFormat& format, int width,
                                                     int height, std::size_t stride);
  Result<> begin_read() const;
  Result<> end_read() const;
};

}  // namespace orbwatch::hal
