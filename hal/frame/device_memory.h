// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Device memory that is mapped into this process; unmaps it at its end. Thread-compatible.
class MappedMemory {
 public:
  /// Owns a mapping of mmap.
  explicit MappedMemory(std::span<std::byte> memory) : memory_(memory) {}
  MappedMemory(MappedMemory&& other) noexcept;
  MappedMemory& operator=(MappedMemory&&) = delete;
  ~MappedMemory();

  std::span<std::byte> bytes() const { return memory_; }

 private:
  std::span<std::byte> memory_;
};

/// Device memory shared by descriptor (Linux dma-buf). The CPU reads it through a mapping, between
/// begin_read and end_read only: they synchronise the CPU's caches where the hardware does not.
/// Thread-compatible.
class DmaBuffer {
 public:
  explicit DmaBuffer(FileDescriptor file) : file_(std::move(file)) {}

  int descriptor() const { return file_.get(); }

  /// Maps the first `bytes`. Error: with the system's message.
  Result<MappedMemory> map(std::size_t bytes) const;

  /// Error: the device is gone or refuses, with the system's message.
  Result<> begin_read() const;
  Result<> end_read() const;

 private:
  FileDescriptor file_;
};

}  // namespace orbwatch::hal
