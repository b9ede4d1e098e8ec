// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace orbwatch::hal {

// Places in which the frames of one camera may be at the same time. Code that keeps frames declares
// its limit here, so that a camera's buffers suffice when all of these places are full.

/// Matcher's queue of a free-running camera, deep enough to contain the nearest frame.
inline constexpr std::size_t kFreeRunningDepth = 3;
/// Matcher's FIFO of a triggered camera, each frame of which becomes a set.
inline constexpr std::size_t kTriggeredDepth = 8;
/// Matcher's last used frame: see SyncPolicy::Hold.
inline constexpr std::size_t kHeldFrames = 1;
/// Frame in the set that the pipeline processes.
inline constexpr std::size_t kFramesInSet = 1;
/// Readers of the camera's own pictures; each converts one at a time.
inline constexpr std::size_t kFrameReaders = 2;
/// Frame that an observer of the camera examines, beside the frame path.
inline constexpr std::size_t kWatchedFrames = 1;
/// Frame on the camera's thread, between device and matcher.
inline constexpr std::size_t kArrivingFrames = 1;
/// Buffers left to the device: the one that it fills, and the next.
inline constexpr std::size_t kDeviceBuffers = 2;

/// Number of buffers of a camera whose frames queue up to `depth`.
constexpr std::size_t buffers_for(std::size_t depth) {
  return depth + kHeldFrames + kFramesInSet + kFrameReaders + kWatchedFrames + kArrivingFrames +
         kDeviceBuffers;
}
inline constexpr std::size_t kFreeRunningBuffers = buffers_for(kFreeRunningDepth);
inline constexpr std::size_t kTriggeredBuffers = buffers_for(kTriggeredDepth);

/// Device buffers when each frame is decoded on arrival into one of the buffers above: none leaves
/// the camera's thread, and the spare ones bridge its delays.
inline constexpr std::size_t kDecodedDeviceBuffers = 4 + kDeviceBuffers;

/// Limit for any camera: back-ends keep one bit per buffer in a 32-bit word.
inline constexpr std::size_t kMaxBuffers = 32;
static_assert(kFreeRunningBuffers <= kTriggeredBuffers && kTriggeredBuffers <= kMaxBuffers);

}  // namespace orbwatch::hal
