#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "hal/frame/device_memory.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Where dma-bufs come from that devices import and fill, and that the CPU caches.
struct DmaBufferSource {
  std::string name;  ///< for the log: "dma-heap system"
  /// A dma-buf of `bytes` at least. Error: with the system's message.
  std::function<Result<DmaBuffer>(std::size_t bytes)> allocate;
};

/// The sources that exist now, in the order of preference. Asked for at each start of a stream.
using DmaBufferSources = std::function<std::vector<DmaBufferSource>()>;

/// The memory that a stream's buffers lie in.
struct FrameMemory {
  std::string source;    ///< name of the DmaBufferSource; empty: the driver's own
  std::string refusals;  ///< why it is none of the preferred sources; empty: it is the first
};

/// The first of `sources` with which `attempt` succeeds, or the driver's own memory.
FrameMemory choose_memory(const std::vector<DmaBufferSource>& sources,
                          const std::function<Result<>(const DmaBufferSource&)>& attempt);

/// For the log: the memory, and the buffers that were made of those `requested`.
std::string to_text(const FrameMemory& memory, std::size_t buffers, std::size_t requested);

}  // namespace orbwatch::hal
