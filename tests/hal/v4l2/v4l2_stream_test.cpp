// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/v4l2_stream.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

namespace orbwatch::hal {
namespace {

std::unique_ptr<DriverFrame> make_frame() {
  void* const memory =
      ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  EXPECT_NE(memory, MAP_FAILED);
  std::vector<BufferMemory> memory_planes;
  memory_planes.push_back({MappedMemory({static_cast<std::byte*>(memory), 4096}), std::nullopt});
  return std::make_unique<DriverFrame>(std::move(memory_planes));
}

TEST(DriverFrame, StaysMappedWhileAFrameIsHeldAfterTheStreamIsGone) {
  Frame held;
  std::weak_ptr<ReturnedBuffers> bell;
  {
    const auto returned = std::make_shared<ReturnedBuffers>();
    bell = returned;
    std::vector<std::unique_ptr<DriverFrame>> frames;
    frames.push_back(make_frame());
    BufferPool<DriverFrame> pool(std::move(frames),
                                 [returned](std::size_t index) { returned->put(index); });
    auto loan = pool.acquire(0);
    EXPECT_EQ(loan->capacity, 4096U);
    loan->memory[4095] = std::byte{42};
    held = std::move(loan);
    EXPECT_EQ(returned->take(), 0U);
  }
  const std::byte* const last = static_cast<const DriverFrame&>(*held).memory + 4095;
  EXPECT_EQ(*last, std::byte{42});
  void* const page = const_cast<std::byte*>(last - 4095);
  held.reset();
  EXPECT_EQ(::msync(page, 4096, MS_ASYNC), -1) << "unmapped with the last frame";
  EXPECT_TRUE(bell.expired());
}

}  // namespace
}  // namespace orbwatch::hal
