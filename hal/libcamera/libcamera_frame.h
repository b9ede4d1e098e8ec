#pragma once

#include <libcamera/framebuffer.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hal/device_result.h"
#include "hal/frame.h"
#include "hal/libcamera/libcamera_format.h"

namespace orbwatch::hal {

/// A dma-buf in this process, mapped once, for reading. Neither copyable nor movable.
class DmaBuffer {
 public:
  /// Maps the first `length` bytes. Error: the system's.
  static Result<std::unique_ptr<DmaBuffer>> map(const libcamera::SharedFD& file,
                                                std::size_t length);
  DmaBuffer(const DmaBuffer&) = delete;
  DmaBuffer& operator=(const DmaBuffer&) = delete;
  ~DmaBuffer();

  std::span<const std::byte> bytes() const { return {memory_, length_}; }
  bool is_of(const libcamera::SharedFD& file) const { return file_.get() == file.get(); }

  /// Begins reading: what the device wrote becomes visible to the CPU. Error: the system's.
  Result<> begin_read() const;
  /// Ends reading, before the device writes again.
  Result<> end_read() const;

 private:
  DmaBuffer(libcamera::SharedFD file, const std::byte* memory, std::size_t length)
      : file_(std::move(file)), memory_(memory), length_(length) {}

  libcamera::SharedFD file_;
  const std::byte* memory_;
  std::size_t length_;
};

/// A frame in libcamera's buffer, which stays mapped for as long as the frame is held, also after
/// its stream has ended. Nobody but the device writes to it.
struct LibcameraFrame : FrameBuffer {
  std::vector<std::unique_ptr<DmaBuffer>> dma_buffers;

  /// Maps the planes of `buffer` and describes the picture in them. Errors: cannot be mapped, too
  /// small.
  static Result<std::unique_ptr<LibcameraFrame>> map(const libcamera::FrameBuffer& buffer,
                                                     const LibcameraFormat& format, int width,
                                                     int height, std::size_t stride);
  Result<> begin_read() const;
  Result<> end_read() const;
};

}  // namespace orbwatch::hal
