// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/frame_memory.h"

namespace orbwatch::hal {

FrameMemory choose_memory(const std::vector<DmaBufferSource>& sources,
                          const std::function<Result<>(const DmaBufferSource&)>& attempt) {
  FrameMemory memory;
  for (const DmaBufferSource& source : sources) {
    const auto works = attempt(source);
    if (works) {
      memory.source = source.name;
      return memory;
    }
    if (!memory.refusals.empty()) memory.refusals += "; ";
    memory.refusals += source.name + ": " + works.error().message;
  }
  if (sources.empty()) memory.refusals = "there is no dma-heap for it";
  return memory;
}

std::string to_text(const FrameMemory& memory, std::size_t buffers, std::size_t requested) {
  std::string text = std::to_string(buffers) + " buffers";
  if (buffers < requested) text += " instead of " + std::to_string(requested);
  text += memory.source.empty() ? " in memory of the driver, which the CPU may not cache"
                                : " from " + memory.source;
  return memory.refusals.empty() ? text : text + " (" + memory.refusals + ")";
}

}  // namespace orbwatch::hal
