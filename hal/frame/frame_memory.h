// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "hal/frame/device_memory.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Source of dma-bufs that devices import and fill, and that the CPU caches.
struct DmaBufferSource {
  std::string name;  ///< for the log: "dma-heap system"
  /// Allocates a dma-buf of at least `bytes`. Error: with the system's message.
  std::function<Result<DmaBuffer>(std::size_t bytes)> allocate;
};

/// Sources that exist now, in the order of preference. Called at each start of a stream.
using DmaBufferSources = std::function<std::vector<DmaBufferSource>()>;

/// Memory that a stream's buffers lie in.
struct FrameMemory {
  std::string source;    ///< name of the DmaBufferSource; empty: the driver's own
  std::string refusals;  ///< reasons why preferred sources were not used; empty: it is the first
};

/// Returns the first of `sources` with which `attempt` succeeds, or the driver's own memory.
FrameMemory choose_memory(const std::vector<DmaBufferSource>& sources,
                          const std::function<Result<>(const DmaBufferSource&)>& attempt);

/// Text for the log: the memory, and the number of buffers made of those `requested`.
std::string to_text(const FrameMemory& memory, std::size_t buffers, std::size_t requested);

}  // namespace orbwatch::hal
