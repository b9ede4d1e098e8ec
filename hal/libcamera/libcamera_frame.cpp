#include "hal/libcamera/libcamera_frame.h"

#include <libcamera/base/unique_fd.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <span>
#include <string>
#include <system_error>

namespace orbwatch::hal {
namespace {

/// The planes' common dma-buf reaches to the end of the last of them.
std::size_t length_of(const libcamera::FrameBuffer& buffer, const libcamera::SharedFD& file) {
  std::size_t length = 0;
  for (const auto& plane : buffer.planes()) {
    if (plane.fd.get() != file.get()) continue;
    length = std::max(length, std::size_t{plane.offset} + plane.length);
  }
  return length;
}

Result<MappedDmaBuffer> map_file(const libcamera::SharedFD& file, std::size_t length) {
  void* const memory = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, file.get(), 0);
  if (memory == MAP_FAILED) {
    return fail("cannot map a buffer: " + std::generic_category().message(errno));
  }
  return MappedDmaBuffer{DmaBuffer(FileDescriptor(file.dup().release())),
                         MappedMemory({static_cast<std::byte*>(memory), length})};
}

}  // namespace

Result<std::unique_ptr<LibcameraFrame>> LibcameraFrame::map(const libcamera::FrameBuffer& buffer,
                                                            const LibcameraFormat& format,
                                                            int width, int height,
                                                            std::size_t stride) {
  auto frame = std::make_unique<LibcameraFrame>();
  std::vector<int> files;  // of each mapped one, as libcamera numbers it
  std::vector<std::span<const std::byte>> planes;
  for (const auto& plane : buffer.planes()) {
    auto known = std::find(files.begin(), files.end(), plane.fd.get());
    if (known == files.end()) {
      auto mapped = map_file(plane.fd, length_of(buffer, plane.fd));
      if (!mapped) return tl::unexpected(mapped.error());
      frame->dma_buffers.push_back(std::move(*mapped));
      known = files.insert(files.end(), plane.fd.get());
    }
    const auto& memory = frame->dma_buffers[static_cast<std::size_t>(known - files.begin())].memory;
    planes.push_back(memory.bytes().subspan(plane.offset, plane.length));
  }
  const auto picture = lay_out(format, width, height, stride, planes);
  if (!picture) return tl::unexpected(picture.error());
  frame->picture = *picture;
  return frame;
}

Result<> LibcameraFrame::begin_read() const {
  for (const MappedDmaBuffer& buffer : dma_buffers) {
    if (auto begun = buffer.file.begin_read(); !begun) return begun;
  }
  return {};
}

Result<> LibcameraFrame::end_read() const {
  for (const MappedDmaBuffer& buffer : dma_buffers) {
    if (auto ended = buffer.file.end_read(); !ended) return ended;
  }
  return {};
}

}  // namespace orbwatch::hal
