// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/device_memory.h"

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace orbwatch::hal {
namespace {

Result<> synchronise(const FileDescriptor& file, unsigned long long moment) {
  dma_buf_sync sync{DMA_BUF_SYNC_READ | moment};
  // The kernel's documentation requires the repetition.
  while (::ioctl(file.get(), DMA_BUF_IOCTL_SYNC, &sync) != 0) {
    if (errno == EINTR || errno == EAGAIN) continue;
    // Plain shared memory, which software pipelines fill, needs no synchronisation.
    if (errno == ENOTTY) return {};
    return fail("cannot synchronise a dma-buf: " + std::generic_category().message(errno));
  }
  return {};
}

}  // namespace

MappedMemory::MappedMemory(MappedMemory&& other) noexcept
    : memory_(std::exchange(other.memory_, {})) {}

MappedMemory::~MappedMemory() {
  if (!memory_.empty()) ::munmap(memory_.data(), memory_.size());
}

Result<MappedMemory> DmaBuffer::map(std::size_t bytes) const {
  void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_.get(), 0);
  if (memory == MAP_FAILED) {
    return fail("cannot map a dma-buf: " + std::generic_category().message(errno));
  }
  return MappedMemory({static_cast<std::byte*>(memory), bytes});
}

Result<> DmaBuffer::begin_read() const { return synchronise(file_, DMA_BUF_SYNC_START); }

Result<> DmaBuffer::end_read() const { return synchronise(file_, DMA_BUF_SYNC_END); }

}  // namespace orbwatch::hal
