// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/dma_heap.h"

#include <fcntl.h>
#include <linux/dma-heap.h>
#include <sys/ioctl.h>

#include <array>
#include <cerrno>
#include <span>
#include <string>
#include <system_error>
#include <utility>

namespace orbwatch::hal {
namespace {

constexpr std::array kHeaps{"vidbuf_cached", "linux,cma", "system"};
constexpr std::size_t kForAnyDevice = 2;  ///< first of the heaps that suit any device

Result<DmaBuffer> allocate_from(const std::filesystem::path& path, const HeapAllocation& allocate,
                                std::size_t bytes) {
  const FileDescriptor heap(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  if (!heap.is_open()) {
    return fail("cannot be opened: " + std::generic_category().message(errno));
  }
  return allocate(heap.get(), bytes).map([](FileDescriptor file) {
    return DmaBuffer(std::move(file));
  });
}

std::vector<DmaBufferSource> list(std::span<const char* const> names,
                                  const std::filesystem::path& folder,
                                  const HeapAllocation& allocate) {
  std::vector<DmaBufferSource> heaps;
  for (const char* name : names) {
    const std::filesystem::path path = folder / name;
    std::error_code unknown;
    if (!std::filesystem::exists(path, unknown)) continue;
    heaps.push_back({"dma-heap " + std::string(name), [path, allocate](std::size_t bytes) {
                       return allocate_from(path, allocate, bytes);
                     }});
  }
  return heaps;
}

}  // namespace

Result<FileDescriptor> allocate_from_heap(int heap, std::size_t bytes) {
  dma_heap_allocation_data request{};
  request.len = bytes;
  request.fd_flags = O_RDWR | O_CLOEXEC;
  while (::ioctl(heap, DMA_HEAP_IOCTL_ALLOC, &request) != 0) {
    if (errno == EINTR) continue;
    return fail("has no " + std::to_string(bytes) +
                " bytes: " + std::generic_category().message(errno));
  }
  return FileDescriptor(static_cast<int>(request.fd));
}

std::vector<DmaBufferSource> dma_heaps(const std::filesystem::path& folder,
                                       const HeapAllocation& allocate) {
  return list(kHeaps, folder, allocate);
}

std::vector<DmaBufferSource> dma_heaps_for_any_device(const std::filesystem::path& folder,
                                                      const HeapAllocation& allocate) {
  return list(std::span(kHeaps).first(kForAnyDevice), folder, allocate);
}

}  // namespace orbwatch::hal
