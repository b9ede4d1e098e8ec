// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "hal/frame/buffer_count.h"
#include "hal/frame/buffer_pool.h"
#include "hal/frame/frame.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::hal {

/// Buffers of a camera that fills its own memory (simulation, replay, decoded pictures).
using FramePool = BufferPool<FrameBuffer>;

/// Allocates memory for a picture of `width` x `height` in `format`, rows without padding. Pixels
/// are uninitialised: memory becomes resident with the first frame in it.
inline void allocate_picture(FrameBuffer& buffer, PixelFormat format, int width, int height) {
  const int stride = row_bytes(format, width);
  buffer.capacity = picture_bytes(format, static_cast<std::size_t>(stride), height);
  buffer.storage = std::make_unique_for_overwrite<std::byte[]>(buffer.capacity);
  buffer.memory = buffer.storage.get();
  buffer.picture = Picture::contiguous(format, width, height, buffer.memory, stride);
}

/// A pool of `count` buffers, see allocate_picture(). Most are never lent.
inline FramePool make_frame_pool(PixelFormat format, int width, int height,
                                 std::size_t count = kFreeRunningBuffers) {
  std::vector<std::unique_ptr<FrameBuffer>> buffers;
  for (std::size_t i = 0; i < count; ++i) {
    buffers.push_back(std::make_unique<FrameBuffer>());
    allocate_picture(*buffers.back(), format, width, height);
  }
  return FramePool(std::move(buffers));
}

}  // namespace orbwatch::hal
