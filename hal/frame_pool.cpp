#include "hal/frame_pool.h"

#include <utility>
#include <vector>

namespace orbwatch::hal {

FramePool make_frame_pool(PixelFormat format, int width, int height, std::size_t count) {
  std::vector<std::unique_ptr<FrameBuffer>> buffers;
  for (std::size_t i = 0; i < count; ++i) {
    auto buffer = std::make_unique<FrameBuffer>();
    const auto stride = static_cast<std::size_t>(row_bytes(format, width));
    buffer->capacity = stride * static_cast<std::size_t>(height);
    buffer->storage = std::make_unique<std::byte[]>(buffer->capacity);
    buffer->memory = buffer->storage.get();
    buffer->picture.format = format;
    buffer->picture.width = width;
    buffer->picture.height = height;
    buffer->picture.data = buffer->memory;
    buffer->picture.stride = static_cast<std::ptrdiff_t>(stride);
    buffers.push_back(std::move(buffer));
  }
  return FramePool(std::move(buffers));
}

}  // namespace orbwatch::hal
