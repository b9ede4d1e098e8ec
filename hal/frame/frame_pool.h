#pragma once

#include <cstddef>
#include <memory>

#include "hal/frame/buffer_pool.h"
#include "hal/frame/frame.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::hal {

/// Buffers of a camera that fills its own memory (simulation, replay, decoded pictures).
using FramePool = BufferPool<FrameBuffer>;

/// Frames of one camera in use at once: driver, mailbox, sync and pipeline.
inline constexpr std::size_t kFramesPerCamera = 6;

/// A pool of `count` buffers of `width` x `height` in `format`, rows without padding.
FramePool make_frame_pool(PixelFormat format, int width, int height,
                          std::size_t count = kFramesPerCamera);

}  // namespace orbwatch::hal
