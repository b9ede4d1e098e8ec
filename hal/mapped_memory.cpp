#include "hal/mapped_memory.h"

#include <sys/mman.h>

#include <utility>

namespace orbwatch::hal {

MappedMemory::MappedMemory(MappedMemory&& other) noexcept
    : memory_(std::exchange(other.memory_, {})) {}

MappedMemory::~MappedMemory() {
  if (!memory_.empty()) ::munmap(memory_.data(), memory_.size());
}

}  // namespace orbwatch::hal
