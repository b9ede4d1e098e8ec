// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/device_memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cerrno>
#include <utility>

namespace orbwatch::hal {
namespace {

TEST(MappedMemory, IsUnmappedByItsLastOwner) {
  void* const memory = ::mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  {
    MappedMemory first({static_cast<std::byte*>(memory), 4096});
    const MappedMemory second(std::move(first));
    EXPECT_EQ(::msync(memory, 4096, MS_ASYNC), 0) << "mapped while it is owned";
    EXPECT_EQ(second.bytes().size(), 4096U);
  }
  EXPECT_EQ(::msync(memory, 4096, MS_ASYNC), -1);
  EXPECT_EQ(errno, ENOMEM);
}

}  // namespace
}  // namespace orbwatch::hal
