// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "hal/frame/frame_memory.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {

/// Allocates a dma-buf of at least `bytes` from an open heap.
using HeapAllocation = std::function<Result<FileDescriptor>(int heap, std::size_t bytes)>;

/// DMA_HEAP_IOCTL_ALLOC. Error: the system's message. Reentrant.
Result<FileDescriptor> allocate_from_heap(int heap, std::size_t bytes);

/// The kernel's heaps in `folder` whose buffers the CPU caches, in the order of rpicam-apps: video
/// memory of Raspberry Pis, contiguous memory, any memory. The last suits only devices behind an
/// IOMMU; others refuse it. A heap is opened for each allocation; one that may not be opened is
/// listed, so that its error is reported.
std::vector<DmaBufferSource> dma_heaps(const std::filesystem::path& folder = "/dev/dma_heap",
                                       const HeapAllocation& allocate = allocate_from_heap);

/// The heaps whose buffers every camera of the board accepts: all but the heap of any memory.
std::vector<DmaBufferSource> dma_heaps_for_any_device(
    const std::filesystem::path& folder = "/dev/dma_heap",
    const HeapAllocation& allocate = allocate_from_heap);

}  // namespace orbwatch::hal
