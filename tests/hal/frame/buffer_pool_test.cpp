// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/buffer_pool.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <thread>

#include "hal/frame/frame_pool.h"

namespace orbwatch::hal {
namespace {

TEST(BufferPool, LendsEachBufferOnceAndTakesItBack) {
  FramePool pool = make_frame_pool(PixelFormat::Rgb, 4, 2, 2);
  auto first = pool.acquire();
  auto second = pool.acquire();
  ASSERT_TRUE(first && second);
  EXPECT_NE(first.get(), second.get());
  EXPECT_EQ(first->picture.planes[0].stride, 12);
  EXPECT_EQ(first->capacity, 24U);
  EXPECT_EQ(pool.acquire(), nullptr);
  EXPECT_EQ(pool.lent(), 2U);
  first.reset();
  EXPECT_NE(pool.acquire(), nullptr);
  EXPECT_EQ(pool.lent(), 1U);
}

TEST(BufferPool, ALoanOutlivesThePool) {
  Frame frame;
  {
    FramePool pool = make_frame_pool(PixelFormat::Grey, 8, 8, 1);
    auto buffer = pool.acquire();
    buffer->memory[63] = std::byte{7};
    frame = buffer;
  }
  EXPECT_EQ(frame->picture.samples<std::uint8_t>().row(7)[7], 7);
}

std::size_t resident_bytes() {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

TEST(BufferPool, BuffersBecomeResidentWhenTheyAreFilled) {
  constexpr int kSide = 2048;
  constexpr std::size_t kBytes = std::size_t{kSide} * kSide, kCount = 16;
  const std::size_t before = resident_bytes();
  FramePool pool = make_frame_pool(PixelFormat::Grey, kSide, kSide, kCount);
  const auto buffer = pool.acquire();
  std::memset(buffer->memory, 1, buffer->capacity);
  EXPECT_LT(resident_bytes(), before + kCount / 2 * kBytes);
}

TEST(BufferPool, TellsWhichSlotBecameFree) {
  std::vector<std::unique_ptr<int>> buffers;
  for (int i = 0; i < 3; ++i) buffers.push_back(std::make_unique<int>(i));
  std::vector<std::size_t> freed;
  BufferPool<int> pool(std::move(buffers), [&](std::size_t slot) { freed.push_back(slot); });
  auto loan = pool.acquire(2);
  EXPECT_EQ(*loan, 2);
  EXPECT_EQ(pool.acquire(2), nullptr);
  auto copy = loan;
  loan.reset();
  EXPECT_TRUE(freed.empty());
  copy.reset();
  EXPECT_EQ(freed, std::vector<std::size_t>{2});
}

TEST(BufferPool, IsSharedByThreadsWithoutLendingTwice) {
  std::vector<std::unique_ptr<std::atomic<int>>> buffers;
  for (int i = 0; i < 3; ++i) buffers.push_back(std::make_unique<std::atomic<int>>(0));
  BufferPool<std::atomic<int>> pool(std::move(buffers));
  std::atomic<bool> shared{false};
  const auto work = [&] {
    for (int i = 0; i < 20000; ++i) {
      if (auto loan = pool.acquire()) {
        if (loan->fetch_add(1) != 0) shared = true;
        loan->fetch_sub(1);
      }
    }
  };
  std::thread other(work);
  work();
  other.join();
  EXPECT_FALSE(shared);
  EXPECT_EQ(pool.lent(), 0U);
}

}  // namespace
}  // namespace orbwatch::hal
