#include "hal/libcamera/libcamera_frame.h"

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

namespace orbwatch::hal {
namespace {

tl::unexpected<Error> failed(const std::string& action, int error) {
  return fail("cannot " + action + " a buffer: " + std::generic_category().message(error));
}

Result<> synchronise(int file, std::uint64_t flags) {
  dma_buf_sync sync{};
  sync.flags = flags;
  int done = -1;
  do {
    done = ::ioctl(file, DMA_BUF_IOCTL_SYNC, &sync);
  } while (done == -1 && (errno == EINTR || errno == EAGAIN));
  // Plain shared memory, which software pipelines fill, needs none.
  if (done == -1 && errno != ENOTTY) return failed("synchronise", errno);
  return {};
}

/// The planes' common dma-buf reaches to the end of the last of them.
std::size_t length_of(const libcamera::FrameBuffer& buffer, const libcamera::SharedFD& file) {
  std::size_t length = 0;
  for (const auto& plane : buffer.planes()) {
    if (plane.fd.get() != file.get()) continue;
    length = std::max(length, std::size_t{plane.offset} + plane.length);
  }
  return length;
}

}  // namespace

Result<std::unique_ptr<DmaBuffer>> DmaBuffer::map(const libcamera::SharedFD& file,
                                                  std::size_t length) {
  void* const memory = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, file.get(), 0);
  if (memory == MAP_FAILED) return failed("map", errno);
  return std::unique_ptr<DmaBuffer>(
      new DmaBuffer(file, static_cast<const std::byte*>(memory), length));
}

DmaBuffer::~DmaBuffer() { ::munmap(const_cast<std::byte*>(memory_), length_); }

Result<> DmaBuffer::begin_read() const {
  return synchronise(file_.get(), DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ);
}

Result<> DmaBuffer::end_read() const {
  return synchronise(file_.get(), DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ);
}

Result<std::unique_ptr<LibcameraFrame>> LibcameraFrame::map(const libcamera::FrameBuffer& buffer,
                                                            const LibcameraFormat& format,
                                                            int width, int height,
                                                            std::size_t stride) {
  auto frame = std::make_unique<LibcameraFrame>();
  std::vector<std::span<const std::byte>> planes;
  for (const auto& plane : buffer.planes()) {
    auto& mapped = frame->dma_buffers;
    auto known = std::find_if(mapped.begin(), mapped.end(),
                              [&plane](const auto& other) { return other->is_of(plane.fd); });
    if (known == mapped.end()) {
      auto made = DmaBuffer::map(plane.fd, length_of(buffer, plane.fd));
      if (!made) return tl::unexpected(made.error());
      known = mapped.insert(mapped.end(), std::move(*made));
    }
    planes.push_back((*known)->bytes().subspan(plane.offset, plane.length));
  }
  const auto picture = lay_out(format, width, height, stride, planes);
  if (!picture) return tl::unexpected(picture.error());
  frame->picture = *picture;
  return frame;
}

Result<> LibcameraFrame::begin_read() const {
  for (const auto& buffer : dma_buffers) {
    if (auto begun = buffer->begin_read(); !begun) return begun;
  }
  return {};
}

Result<> LibcameraFrame::end_read() const {
  for (const auto& buffer : dma_buffers) {
    if (auto ended = buffer->end_read(); !ended) return ended;
  }
  return {};
}

}  // namespace orbwatch::hal
