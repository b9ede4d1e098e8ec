#pragma once

#include <cstddef>

namespace orbwatch::hal {

// Where the frames of one camera may be at once. Whoever keeps frames declares its limit here, so
// that the buffers of a camera suffice when all of these places are full.

/// The matcher's queue of a camera that runs freely, so that the nearest frame is among them.
inline constexpr std::size_t kFreeRunningDepth = 3;
/// The matcher's FIFO of a triggered camera, each frame of which becomes a set.
inline constexpr std::size_t kTriggeredDepth = 8;
/// The matcher's last used frame: see SyncPolicy::Hold.
inline constexpr std::size_t kHeldFrames = 1;
/// In the set that the pipeline processes.
inline constexpr std::size_t kFramesInSet = 1;
/// Readers of the camera's own pictures, each of which converts one at a time.
inline constexpr std::size_t kFrameReaders = 2;
/// Looked at by whoever watches the camera, beside the frame path.
inline constexpr std::size_t kWatchedFrames = 1;
/// On the camera's thread, between device and matcher.
inline constexpr std::size_t kArrivingFrames = 1;
/// Left to the device: the one that it fills, and the next.
inline constexpr std::size_t kDeviceBuffers = 2;

/// Buffers of a camera whose frames queue up to `depth`.
constexpr std::size_t buffers_for(std::size_t depth) {
  return depth + kHeldFrames + kFramesInSet + kFrameReaders + kWatchedFrames + kArrivingFrames +
         kDeviceBuffers;
}
inline constexpr std::size_t kFreeRunningBuffers = buffers_for(kFreeRunningDepth);
inline constexpr std::size_t kTriggeredBuffers = buffers_for(kTriggeredDepth);

/// A device's buffers when each frame is decoded on arrival into a buffer of the above: none leaves
/// the camera's thread, and the spare ones bridge its delays.
inline constexpr std::size_t kDecodedDeviceBuffers = 4 + kDeviceBuffers;

/// Of any camera: back-ends keep one bit per buffer in 32.
inline constexpr std::size_t kMaxBuffers = 32;
static_assert(kFreeRunningBuffers <= kTriggeredBuffers && kTriggeredBuffers <= kMaxBuffers);

}  // namespace orbwatch::hal
