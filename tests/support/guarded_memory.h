// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace orbwatch::tests {

/// Memory with unreadable pages before and after it.
class GuardedMemory {
 public:
  explicit GuardedMemory(std::size_t most)
      : bytes_((most / kGuard + 1) * kGuard),
        all_(::mmap(nullptr, bytes_ + 2 * kGuard, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)),
        begin_(static_cast<std::uint8_t*>(all_) + kGuard) {
    if (all_ == MAP_FAILED || ::mprotect(begin_, bytes_, PROT_READ | PROT_WRITE) != 0) std::abort();
  }
  ~GuardedMemory() { ::munmap(all_, bytes_ + 2 * kGuard); }
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;

  std::span<std::uint8_t> first(std::size_t bytes) { return {begin_, bytes}; }
  std::span<std::uint8_t> last(std::size_t bytes) { return {begin_ + bytes_ - bytes, bytes}; }

 private:
  static constexpr std::size_t kGuard = 1 << 16;  ///< no machine has larger pages

  std::size_t bytes_;
  void* all_;
  std::uint8_t* begin_;
};

}  // namespace orbwatch::tests
