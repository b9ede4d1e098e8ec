#include "hal/frame/frame_pool.h"

#include <utility>
#include <vector>

namespace orbwatch::hal {

FramePool make_frame_pool(PixelFormat format, int width, int height, std::size_t count) {
  std::vector<std::unique_ptr<FrameBuffer>> buffers;
  for (std::size_t i = 0; i < count; ++i) {
    auto buffer = std::make_unique<FrameBuffer>();
    const int stride = row_bytes(format, width);
    buffer->capacity = picture_bytes(format, static_cast<std::size_t>(stride), height);
    buffer->storage = std::make_unique<std::byte[]>(buffer->capacity);
    buffer->memory = buffer->storage.get();
    buffer->picture = Picture::contiguous(format, width, height, buffer->memory, stride);
    buffers.push_back(std::move(buffer));
  }
  return FramePool(std::move(buffers));
}

}  // namespace orbwatch::hal
