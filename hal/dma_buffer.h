#pragma once

#include <utility>

#include "hal/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// A device's memory under a descriptor that other devices take, too (Linux' dma-buf). What the CPU
/// reads of it through a mapping is what the device wrote only between begin_read and end_read:
/// they keep the CPU's caches in step where the hardware does not. Thread-compatible.
class DmaBuffer {
 public:
  explicit DmaBuffer(FileDescriptor file) : file_(std::move(file)) {}

  int descriptor() const { return file_.get(); }

  /// Error: the device is gone or refuses, with the system's message.
  Result<> begin_read() const;
  Result<> end_read() const;

 private:
  FileDescriptor file_;
};

}  // namespace orbwatch::hal
