#include "hal/frame_sync.h"

#include <gtest/gtest.h>

#include <thread>

#include "hal/frame_pool.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

const TimePoint kStart = Clock::now();

Frame frame(std::uint64_t sequence, int exposed_ms) {
  auto buffer = std::make_shared<FrameBuffer>();
  buffer->metadata.sequence = sequence;
  buffer->metadata.exposure_start = kStart + milliseconds(exposed_ms);
  return buffer;
}

/// Long enough that only a fault of the code reaches it.
TimePoint soon() { return Clock::now() + std::chrono::seconds(20); }
TimePoint now() { return Clock::now(); }

TEST(FrameSync, JoinsFramesWithinTheWindow) {
  FrameSync sync(2, milliseconds(5));
  sync.put(1, frame(0, 3));
  sync.put(0, frame(0, 0));
  const auto set = sync.next(soon());
  ASSERT_TRUE(set);
  EXPECT_EQ(set->id, 1U);
  EXPECT_EQ(set->stamp, kStart);
  EXPECT_TRUE(set->matched);
  EXPECT_EQ(set->frames[1]->metadata.exposure_start, kStart + milliseconds(3));
  EXPECT_FALSE(sync.next(now())) << "each frame paces once";
}

TEST(FrameSync, WaitsForAPartnerThatComesLater) {
  FrameSync sync(2, std::chrono::seconds(10));
  sync.put(0, frame(0, 0));
  sync.put(1, frame(0, 0));
  ASSERT_TRUE(sync.next(soon()));
  sync.put(0, frame(1, 20000));  // the partner's held frame is too old for it
  EXPECT_FALSE(sync.next(now()));
  std::thread later([&] { sync.put(1, frame(1, 20001)); });
  const auto set = sync.next(soon());
  later.join();
  ASSERT_TRUE(set);
  EXPECT_EQ(set->frames[1]->metadata.sequence, 1U);
  EXPECT_TRUE(set->matched);
}

TEST(FrameSync, HoldsTheLastFrameOfASlowCamera) {
  FrameSync sync(2, milliseconds(1));
  sync.put(0, frame(0, 0));
  sync.put(1, frame(0, 0));
  ASSERT_TRUE(sync.next(soon()));
  sync.put(0, frame(1, 100));
  const auto set = sync.next(soon());  // comes when the window's patience is over
  ASSERT_TRUE(set);
  EXPECT_EQ(set->frames[1]->metadata.sequence, 0U);
  EXPECT_FALSE(set->matched);
}

TEST(FrameSync, LeavesAPartnerOfTheFutureForALaterSet) {
  FrameSync sync(2, milliseconds(1));
  sync.put(0, frame(0, 0));
  sync.put(1, frame(0, 0));
  ASSERT_TRUE(sync.next(soon()));
  sync.put(1, frame(1, 200));
  sync.put(0, frame(1, 100));
  EXPECT_EQ(sync.next(soon())->frames[1]->metadata.sequence, 0U);
  sync.put(0, frame(2, 200));
  const auto set = sync.next(soon());
  EXPECT_EQ(set->frames[1]->metadata.sequence, 1U);
  EXPECT_TRUE(set->matched);
}

TEST(FrameSync, CountsLostAndDroppedFrames) {
  FrameSync sync(1, milliseconds(1));
  sync.put(0, frame(0, 0));
  sync.put(0, frame(1, 10));
  sync.put(0, frame(5, 50));
  EXPECT_EQ(sync.next(soon())->frames[0]->metadata.sequence, 5U) << "the newest wins";
  EXPECT_EQ(sync.counts(0).frames, 3U);
  EXPECT_EQ(sync.counts(0).dropped, 2U);
  EXPECT_EQ(sync.counts(0).lost, 3U);
  sync.put(0, frame(0, 60));  // the camera was restarted
  EXPECT_EQ(sync.counts(0).lost, 3U);
}

TEST(FrameSync, AnotherCameraPacesWhileTheFirstHasAFault) {
  FrameSync sync(2, milliseconds(1));
  sync.put(0, frame(0, 0));
  sync.put(1, frame(0, 0));
  ASSERT_TRUE(sync.next(soon()));
  sync.clear(0);
  sync.put(1, frame(1, 100));
  const auto set = sync.next(soon());
  ASSERT_TRUE(set);
  EXPECT_EQ(set->frames[0], nullptr);
  EXPECT_EQ(set->frames[1]->metadata.sequence, 1U);
  EXPECT_TRUE(set->matched) << "a missing camera is a fault, not a mismatch";
}

TEST(FrameSync, ClosingEndsAWait) {
  FrameSync sync(1, milliseconds(1));
  std::thread closer([&] { sync.close(); });
  EXPECT_FALSE(sync.next(soon()));
  closer.join();
  EXPECT_LT(Clock::now(), kStart + std::chrono::seconds(20));
}

}  // namespace
}  // namespace orbwatch::hal
