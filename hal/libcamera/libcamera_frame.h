#pragma once

#include <libcamera/framebuffer.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "hal/dma_buffer.h"
#include "hal/frame.h"
#include "hal/libcamera/libcamera_format.h"
#include "hal/mapped_memory.h"

namespace orbwatch::hal {

/// A dma-buf of libcamera's, mapped for reading.
struct MappedDmaBuffer {
  DmaBuffer file;
  MappedMemory memory;
};

/// A frame in libcamera's buffer, which stays mapped for as long as the frame is held, also after
/// its stream has ended. Nobody but the device writes to it.
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
