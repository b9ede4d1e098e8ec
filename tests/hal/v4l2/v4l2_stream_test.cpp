#include "hal/v4l2/v4l2_stream.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/mman.h>

#include <thread>

namespace orbwatch::hal {
namespace {

bool is_readable(const ReturnedBuffers& returned) {
  pollfd file{returned.descriptor(), POLLIN, 0};
  return ::poll(&file, 1, 0) == 1;
}

TEST(ReturnedBuffers, IsReadableUntilItIsTaken) {
  ReturnedBuffers returned;
  ASSERT_TRUE(returned.is_open());
  EXPECT_FALSE(is_readable(returned));
  returned.put(0);
  returned.put(31);
  EXPECT_TRUE(is_readable(returned));
  EXPECT_EQ(returned.take(), 0x80000001U);
  EXPECT_FALSE(is_readable(returned));
  EXPECT_EQ(returned.take(), 0U);
  returned.wake();
  EXPECT_TRUE(is_readable(returned));
  EXPECT_EQ(returned.take(), 0U);
}

TEST(ReturnedBuffers, LosesNoneBetweenThreads) {
  ReturnedBuffers returned;
  constexpr int kRounds = 2000;
  std::thread releasing([&] {
    for (int i = 0; i < kRounds; ++i) {
      while (is_readable(returned)) std::this_thread::yield();
      returned.put(static_cast<std::size_t>(i % 2));
    }
  });
  int taken = 0;
  while (taken < kRounds) {
    pollfd file{returned.descriptor(), POLLIN, 0};
    ASSERT_EQ(::poll(&file, 1, 60'000), 1) << "a release was lost after " << taken;
    const std::uint32_t bits = returned.take();
    taken += static_cast<int>(bits & 1U) + static_cast<int>(bits >> 1 & 1U);
  }
  releasing.join();
}

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
