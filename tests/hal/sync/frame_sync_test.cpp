// SPDX-License-Identifier: Apache-2.0
#include "hal/sync/frame_sync.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "hal/frame/frame_pool.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

const TimePoint kProgramStart = Clock::now();
constexpr std::chrono::seconds kGuard{20};  ///< reached only when the code is wrong

Frame live_frame(std::uint64_t sequence, int exposed_ms) {
  auto buffer = std::make_shared<FrameBuffer>();
  buffer->metadata.sequence = sequence;
  buffer->metadata.exposure_start = kProgramStart + milliseconds(exposed_ms);
  return buffer;
}

TimePoint soon() { return Clock::now() + kGuard; }

TEST(FrameSync, WaitsForAPartnerThatComesLater) {
  FrameSync sync(2, {.window = milliseconds(10), .max_wait = 2 * kGuard});
  sync.put(0, live_frame(1, 20));
  EXPECT_FALSE(sync.next(Clock::now()));
  EXPECT_FALSE(sync.has_set());
  std::thread later([&] { sync.put(1, live_frame(1, 21)); });
  const auto set = sync.next(soon());
  later.join();
  ASSERT_TRUE(set);
  EXPECT_FALSE(sync.has_set());
  EXPECT_EQ(set->frames[1]->metadata.sequence, 1U);
  EXPECT_TRUE(set->matched);
}

TEST(FrameSync, MaxWaitEndsByItself) {
  FrameSync sync(2, {.window = milliseconds(1), .max_wait = milliseconds(1)});
  sync.put(0, live_frame(0, 0));
  const auto set = sync.next(soon());
  ASSERT_TRUE(set);
  EXPECT_EQ(set->frames[1], nullptr);
  EXPECT_FALSE(set->matched);
}

TEST(FrameSync, AFaultEndsTheWaitForACamera) {
  FrameSync sync(2, {.window = milliseconds(1), .max_wait = 2 * kGuard});
  sync.put(0, live_frame(0, 0));
  std::thread later([&] { sync.clear(1); });
  EXPECT_TRUE(sync.next(soon()));
  later.join();
  sync.put(0, live_frame(1, 30));
  EXPECT_TRUE(sync.has_set());
}

TEST(FrameSync, ClosingEndsAWait) {
  FrameSync sync(1, {});
  const TimePoint deadline = soon();
  std::thread closer([&] { sync.close(); });
  EXPECT_FALSE(sync.next(deadline));
  closer.join();
  EXPECT_LT(Clock::now(), deadline);
}

TEST(FrameSync, ATriggeredCamerasQueueFillsWhileAllOtherPlacesAreFull) {
  FramePool pool = make_frame_pool(PixelFormat::Grey, 1, 1, kTriggeredBuffers);
  FrameSync sync(1, {});
  std::uint64_t trigger = 0;
  const auto expose = [&] {
    const auto buffer = pool.acquire();
    ASSERT_TRUE(buffer) << "no buffer is left for trigger " << trigger;
    buffer->metadata = {.sequence = trigger, .exposure_start = Clock::now(), .trigger = trigger};
    sync.put(0, buffer);
    ++trigger;
  };
  expose();
  const auto processed = sync.next(soon());
  ASSERT_TRUE(processed);
  std::vector<Frame> others;  // the held older frame, and those of readers and watch
  for (std::size_t n = 0; n < kHeldFrames + kFrameReaders + kWatchedFrames; ++n) {
    others.push_back(pool.acquire());
  }
  for (std::size_t n = 0; n < kTriggeredDepth; ++n) expose();
  EXPECT_EQ(sync.counts(0).dropped(), 0U);
  EXPECT_EQ(pool.size() - pool.lent(), kArrivingFrames + kDeviceBuffers);
  expose();
  EXPECT_EQ(sync.counts(0).overflowed, 1U);
  EXPECT_EQ(pool.size() - pool.lent(), kArrivingFrames + kDeviceBuffers) << "the oldest came back";
}

// Threads of four cameras, faults and a consumer at the same time: buffers of real pools, all of
// which are returned.
TEST(FrameSync, KeepsNoBufferAndCountsEachUnderFullLoad) {
  constexpr std::size_t kCameras = 4;
  constexpr std::uint64_t kFrames = 3000;
  FrameSync sync(kCameras, {});
  std::vector<FramePool> pools;
  for (std::size_t i = 0; i < kCameras; ++i) {
    pools.push_back(make_frame_pool(PixelFormat::Grey, 1, 1));
  }
  std::array<std::uint64_t, kMaxCameras> sent{}, used{};
  std::vector<std::thread> cameras;
  for (std::size_t i = 0; i < kCameras; ++i) {
    cameras.emplace_back([&, i] {
      for (std::uint64_t n = 0; n < kFrames; ++n) {
        const auto buffer = pools[i].acquire();
        if (!buffer) continue;
        buffer->metadata = {.sequence = n, .exposure_start = Clock::now()};
        sync.put(i, buffer);
        ++sent[i];
        if (n % 500 == 499) sync.clear(i);
      }
    });
  }
  std::thread closer([&] {
    for (std::thread& camera : cameras) camera.join();
    sync.close();
  });
  while (const auto set = sync.next(soon())) {
    for (std::size_t i = 0; i < kCameras; ++i) used[i] += set->frames[i] && !set->held[i] ? 1 : 0;
  }
  closer.join();
  for (std::size_t i = 0; i < kCameras; ++i) {
    sync.clear(i);
    const FrameCounts counts = sync.counts(i);
    EXPECT_EQ(counts.frames, sent[i]);
    EXPECT_EQ(counts.used, used[i]);
    EXPECT_EQ(counts.frames, counts.used + counts.unmatched + counts.dropped());
    EXPECT_EQ(pools[i].lent(), 0U);
  }
}

}  // namespace
}  // namespace orbwatch::hal
