#pragma once

#include <cstddef>
#include <span>

namespace orbwatch::hal {

/// A stretch of a device's memory in this process, unmapped at its end. Thread-compatible.
class MappedMemory {
 public:
  /// Takes what mmap gave.
  explicit MappedMemory(std::span<std::byte> memory) : memory_(memory) {}
  MappedMemory(MappedMemory&& other) noexcept;
  MappedMemory& operator=(MappedMemory&&) = delete;
  ~MappedMemory();

  std::span<std::byte> bytes() const { return memory_; }

 private:
  std::span<std::byte> memory_;
};

}  // namespace orbwatch::hal
