// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <linux/udmabuf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>

#include "hal/frame/frame_memory.h"

/// Memory to import on kernels without dma-heaps, such as Debian's.
namespace orbwatch::hal {

inline tl::unexpected<Error> failed_call(const char* call) {
  return fail(std::string(call) + ": " + std::generic_category().message(errno));
}

/// Plain shared memory, whole pages: can be mapped, but no device imports it.
inline Result<FileDescriptor> allocate_shared_memory(std::size_t bytes) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  FileDescriptor file(::memfd_create("frame", MFD_ALLOW_SEALING | MFD_CLOEXEC));
  const auto size = static_cast<off_t>((bytes + page - 1) / page * page);
  if (::ftruncate(file.get(), size) != 0) return failed_call("ftruncate");
  if (::fcntl(file.get(), F_ADD_SEALS, F_SEAL_SHRINK) != 0) return failed_call("F_ADD_SEALS");
  return file;
}

/// Allocates a real dma-buf of such memory.
inline Result<DmaBuffer> allocate_udmabuf(std::size_t bytes) {
  const auto memory = allocate_shared_memory(bytes);
  if (!memory) return tl::unexpected(memory.error());
  const FileDescriptor device(::open("/dev/udmabuf", O_RDWR | O_CLOEXEC));
  udmabuf_create request{};
  request.memfd = static_cast<std::uint32_t>(memory->get());
  request.flags = UDMABUF_FLAGS_CLOEXEC;
  request.size = static_cast<std::uint64_t>(::lseek(memory->get(), 0, SEEK_END));
  FileDescriptor buffer(::ioctl(device.get(), UDMABUF_CREATE, &request));
  if (!buffer.is_open()) return failed_call("UDMABUF_CREATE");
  return DmaBuffer(std::move(buffer));
}

inline DmaBufferSource udmabuf() { return {"udmabuf", allocate_udmabuf}; }

inline DmaBufferSource shared_memory() {
  return {"shared memory", [](std::size_t bytes) {
            return allocate_shared_memory(bytes).map(
                [](FileDescriptor file) { return DmaBuffer(std::move(file)); });
          }};
}

/// Source without memory.
inline DmaBufferSource empty_source() {
  return {"empty", [](std::size_t) -> Result<DmaBuffer> { return fail("has no memory"); }};
}

}  // namespace orbwatch::hal
