// SPDX-License-Identifier: Apache-2.0
#include "hal/sync/frame_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

constexpr TimePoint kStart{std::chrono::hours(1)};

Frame frame(std::uint64_t sequence, int exposed_ms,
            std::optional<std::uint64_t> trigger = std::nullopt) {
  auto buffer = std::make_shared<FrameBuffer>();
  buffer->metadata.sequence = sequence;
  buffer->metadata.exposure_start = kStart + milliseconds(exposed_ms);
  buffer->metadata.trigger = trigger;
  return buffer;
}

/// Matcher, and a clock in milliseconds that only the test advances.
class Matcher {
 public:
  explicit Matcher(std::size_t cameras, const SyncSettings& settings = {})
      : matcher_(cameras, settings) {}

  void put(std::size_t camera, Frame frame) {
    matcher_.put(camera, std::move(frame), now_, released_);
  }
  void clear(std::size_t camera) { matcher_.clear(camera, released_); }
  void advance_to(int ms) { now_ = kStart + milliseconds(ms); }
  std::optional<FrameSet> take() { return matcher_.take(now_, released_); }
  bool has_set() const { return matcher_.has_set(now_); }
  TimePoint wake() const { return matcher_.wake(now_); }
  bool is_late(std::size_t camera) const { return matcher_.is_late(camera, now_); }
  const FrameCounts& counts(std::size_t camera) const { return matcher_.counts(camera); }

 private:
  FrameMatcher matcher_;
  ReleasedFrames released_;
  TimePoint now_ = kStart;
};

/// Sequence number of a camera's frame in a set; -1: none.
int number(const FrameSet& set, std::size_t camera) {
  return set.frames[camera] ? static_cast<int>(set.frames[camera]->metadata.sequence) : -1;
}

constexpr SyncSettings kNearest{.policies = {SyncPolicy::Nearest, SyncPolicy::Nearest}};

TEST(FrameMatcher, JoinsFramesWithinTheWindowAndTellsTheirSkew) {
  Matcher matcher(3);
  matcher.put(1, frame(0, 4));
  matcher.put(0, frame(0, 0));
  EXPECT_FALSE(matcher.take());
  matcher.put(2, frame(7, -3));
  EXPECT_FALSE(matcher.take()) << "its next frame may be nearer";
  matcher.advance_to(10);
  const auto set = matcher.take();
  ASSERT_TRUE(set);
  EXPECT_EQ(set->id, 1U);
  EXPECT_EQ(set->stamp, kStart);
  EXPECT_TRUE(set->matched);
  EXPECT_EQ(set->skew, milliseconds(7));
  EXPECT_EQ(set->age(2), milliseconds(3));
  EXPECT_EQ(number(*set, 2), 7);
  EXPECT_FALSE(matcher.take()) << "each frame paces once";
}

TEST(FrameMatcher, WaitsForTheNearerOfTwoFrames) {
  Matcher matcher(2);
  matcher.put(1, frame(0, -9));
  matcher.put(0, frame(0, 0));
  EXPECT_FALSE(matcher.take());
  matcher.put(1, frame(1, 7));
  EXPECT_EQ(number(matcher.take().value(), 1), 1);
  EXPECT_EQ(matcher.counts(1).unmatched, 1U);
}

TEST(FrameMatcher, DoesNotWaitForAFrameThatCannotBeNearer) {
  Matcher matcher(2);
  matcher.put(1, frame(0, -35));
  matcher.put(1, frame(1, -2));
  matcher.put(0, frame(0, 0));
  EXPECT_EQ(number(matcher.take().value(), 1), 1) << "the next one comes at 31";
}

TEST(FrameMatcher, WaitsForAFrameThatIsDueWithinTheWindow) {
  Matcher matcher(2);
  matcher.put(1, frame(0, -68));
  matcher.put(1, frame(1, -28));
  matcher.put(0, frame(0, 0));
  EXPECT_FALSE(matcher.take());
  matcher.put(1, frame(2, 9));  // due at 12
  EXPECT_EQ(number(matcher.take().value(), 1), 2);
}

TEST(FrameMatcher, HasASetOnceItIsReadyUntilItIsTaken) {
  Matcher matcher(2);
  EXPECT_FALSE(matcher.has_set());
  matcher.put(0, frame(0, 0));
  EXPECT_FALSE(matcher.has_set()) << "its partner may come";
  matcher.put(1, frame(0, 1));
  EXPECT_TRUE(matcher.has_set());
  EXPECT_TRUE(matcher.has_set()) << "it is still there";
  ASSERT_TRUE(matcher.take());
  EXPECT_FALSE(matcher.has_set());
}

TEST(FrameMatcher, KeepsNoFrameThatItDoesNotHold) {
  for (const SyncPolicy policy : {SyncPolicy::Hold, SyncPolicy::Nearest}) {
    Matcher matcher(2, {.policies = {policy, policy}});
    std::array<Frame, 2> frames{frame(0, 0), frame(0, 0)};
    matcher.put(0, frames[0]);
    matcher.put(1, frames[1]);
    ASSERT_TRUE(matcher.take());
    for (const Frame& used : frames) {
      EXPECT_EQ(used.use_count(), policy == SyncPolicy::Hold ? 2 : 1);
    }
  }
}

TEST(FrameMatcher, ASlowCamerasFrameIsHeldWithItsAge) {
  Matcher matcher(2);
  matcher.put(1, frame(0, -100));
  matcher.put(1, frame(1, 0));
  for (int n = 0; n < 4; ++n) {
    matcher.advance_to(17 * n);
    matcher.put(0, frame(static_cast<std::uint64_t>(n), 17 * n));
    const auto set = matcher.take();
    ASSERT_TRUE(set) << "nobody waits for what is not due, frame " << n;
    EXPECT_EQ(number(*set, 1), 1);
    EXPECT_EQ(set->age(1), milliseconds(17 * n));
    EXPECT_EQ(set->held[1], n > 0);
    EXPECT_EQ(set->matched, n == 0);
  }
  EXPECT_EQ(matcher.counts(1).used, 1U);
}

TEST(FrameMatcher, OrLeftOut) {
  Matcher matcher(2, kNearest);
  matcher.put(1, frame(0, -100));
  matcher.put(1, frame(1, 0));
  for (int n = 0; n < 3; ++n) {
    matcher.put(0, frame(static_cast<std::uint64_t>(n), 5 * n));
    matcher.advance_to(100 * (n + 1));
    const auto set = matcher.take();
    ASSERT_TRUE(set);
    EXPECT_EQ(number(*set, 1), n == 0 ? 1 : -1) << "in one set only, though within the window";
    EXPECT_EQ(set->matched, n == 0);
  }
}

TEST(FrameMatcher, ASlowPacerGetsTheNearestFrameOfAFastCamera) {
  Matcher matcher(2, kNearest);
  for (int n = 0; n < 20; ++n) {
    matcher.put(1, frame(static_cast<std::uint64_t>(n), 17 * n));
    if (n % 6 != 5) continue;
    matcher.put(0, frame(static_cast<std::uint64_t>(n / 6), 17 * n - 20));  // late arrival
    const auto set = matcher.take();
    ASSERT_TRUE(set);
    EXPECT_EQ(number(*set, 1), n - 1);
    EXPECT_EQ(set->skew, milliseconds(3));
  }
  const FrameCounts& counts = matcher.counts(1);
  EXPECT_EQ(counts.used, 3U);
  EXPECT_EQ(counts.unmatched, 20U - 3U - 3U) << "all but those that wait";
  EXPECT_EQ(counts.dropped(), 0U);
}

TEST(FrameMatcher, LeavesAFrameOfTheFutureForALaterSet) {
  Matcher matcher(2);
  matcher.put(1, frame(0, 0));
  matcher.put(1, frame(1, 200));
  matcher.put(0, frame(0, 100));
  EXPECT_EQ(number(matcher.take().value(), 1), 0);
  matcher.put(0, frame(1, 200));
  const auto set = matcher.take();
  EXPECT_EQ(number(set.value(), 1), 1);
  EXPECT_TRUE(set->matched);
}

TEST(FrameMatcher, NewestWinsAndLostFramesAreCounted) {
  Matcher matcher(1);
  matcher.put(0, frame(0, 0));
  matcher.put(0, frame(1, 10));
  matcher.put(0, frame(5, 50));
  EXPECT_EQ(number(matcher.take().value(), 0), 5);
  EXPECT_EQ(matcher.counts(0).frames, 3U);
  EXPECT_EQ(matcher.counts(0).superseded, 2U);
  EXPECT_EQ(matcher.counts(0).lost, 3U);
  matcher.put(0, frame(0, 60));  // restart of the camera
  EXPECT_EQ(matcher.counts(0).lost, 3U);
}

TEST(FrameMatcher, AFastPacerIsNotHeldUpByAMaxWaitThatNeverEnds) {
  Matcher matcher(2, {.window = milliseconds(500), .max_wait = milliseconds(500)});
  int sets = 0;
  for (int n = 0; n < 30; ++n) {  // the other camera sends neither a frame nor a fault
    matcher.advance_to(10 * n);
    matcher.put(0, frame(static_cast<std::uint64_t>(n), 10 * n));
    sets += matcher.take() ? 1 : 0;
  }
  EXPECT_EQ(sets, 28) << "a full queue does not wait";
  EXPECT_EQ(matcher.counts(0).superseded, 0U);
}

TEST(FrameMatcher, AnotherCameraPacesWhileTheFirstHasAFault) {
  Matcher matcher(2);
  matcher.put(0, frame(0, 0));
  matcher.put(1, frame(0, 0));
  ASSERT_TRUE(matcher.take());
  matcher.put(0, frame(1, 50));
  matcher.clear(0);
  EXPECT_EQ(matcher.counts(0).cleared, 1U);
  matcher.put(1, frame(1, 100));
  const auto set = matcher.take();
  ASSERT_TRUE(set);
  EXPECT_EQ(number(*set, 0), -1);
  EXPECT_EQ(number(*set, 1), 1);
  EXPECT_TRUE(set->matched) << "a missing camera is a fault, not a mismatch";
  matcher.clear(1);
  EXPECT_FALSE(matcher.take());
  EXPECT_EQ(matcher.wake(), TimePoint::max());
}

TEST(FrameMatcher, AnotherCameraPacesWhileTheFirstIsSilent) {
  Matcher matcher(2);
  for (int n = 0; n < 3; ++n) {  // both cameras at 20 Hz
    matcher.advance_to(50 * n);
    matcher.put(0, frame(static_cast<std::uint64_t>(n), 50 * n));
    matcher.put(1, frame(static_cast<std::uint64_t>(n), 50 * n + 1));
    ASSERT_TRUE(matcher.take());
  }
  // The first camera becomes silent.
  matcher.advance_to(150);
  matcher.put(1, frame(3, 151));
  EXPECT_FALSE(matcher.take()) << "it may be coming";
  EXPECT_EQ(matcher.wake(), kStart + milliseconds(250) + Clock::duration(1));
  matcher.advance_to(251);
  EXPECT_TRUE(matcher.is_late(0));
  matcher.put(1, frame(5, 251));
  matcher.advance_to(261);
  const auto set = matcher.take();
  ASSERT_TRUE(set);
  EXPECT_EQ(number(*set, 1), 5);
  EXPECT_EQ(number(*set, 0), -1) << "what is old is not shown as new";
  EXPECT_FALSE(set->matched);
  // The first camera delivers again.
  matcher.advance_to(300);
  matcher.put(0, frame(6, 300));
  matcher.put(1, frame(6, 301));
  EXPECT_FALSE(matcher.is_late(0));
  const auto next = matcher.take();
  ASSERT_TRUE(next);
  EXPECT_EQ(number(*next, 0), 6);
  EXPECT_EQ(number(*next, 1), 6);
}

/// The first camera delivers late what it exposed before the last set of the other one.
TEST(FrameMatcher, AFrameFromBeforeTheLastSetMakesNone) {
  Matcher matcher(2);
  for (int n = 0; n < 3; ++n) {  // both cameras at 20 Hz
    matcher.advance_to(50 * n);
    matcher.put(0, frame(static_cast<std::uint64_t>(n), 50 * n));
    matcher.put(1, frame(static_cast<std::uint64_t>(n), 50 * n + 1));
    ASSERT_TRUE(matcher.take());
  }
  matcher.advance_to(260);
  matcher.put(1, frame(5, 251));
  matcher.advance_to(280);
  ASSERT_TRUE(matcher.take());
  matcher.put(0, frame(4, 200));
  matcher.advance_to(300);
  EXPECT_FALSE(matcher.take());
  EXPECT_EQ(matcher.counts(0).unmatched, 1U);
  matcher.put(1, frame(6, 301));
  matcher.put(0, frame(6, 300));
  EXPECT_EQ(number(matcher.take().value(), 0), 6);
}

TEST(FrameMatcher, ACameraWhoseClockWasSetBackPacesNevertheless) {
  Matcher matcher(1);
  matcher.put(0, frame(0, 60'000));
  ASSERT_TRUE(matcher.take());
  matcher.put(0, frame(1, 50));
  EXPECT_EQ(number(matcher.take().value(), 0), 1);
}

TEST(FrameMatcher, ATriggeredCameraIsNeverLate) {
  Matcher matcher(2);
  matcher.put(0, frame(0, 0, 1));
  matcher.put(0, frame(1, 50, 2));
  matcher.advance_to(100000);
  EXPECT_FALSE(matcher.is_late(0));
  matcher.put(1, frame(0, 100000));
  EXPECT_TRUE(matcher.take()) << "of its trigger";
}

TEST(FrameMatcher, WhenAllAreSilentNothingWakes) {
  Matcher matcher(2);
  for (int n = 0; n < 2; ++n) {
    matcher.put(0, frame(static_cast<std::uint64_t>(n), 50 * n));
    matcher.put(1, frame(static_cast<std::uint64_t>(n), 50 * n));
    matcher.advance_to(50 * n + 20);
    while (matcher.take()) {
    }
  }
  matcher.advance_to(10000);
  EXPECT_TRUE(matcher.is_late(0) && matcher.is_late(1));
  EXPECT_EQ(matcher.wake(), TimePoint::max());
}

TEST(FrameMatcher, TriggeredFramesAreJoinedByNumberInOrderWhateverTheirTimes) {
  Matcher matcher(2);
  for (std::uint64_t n = 1; n <= 5; ++n) {
    matcher.put(0, frame(n, static_cast<int>(10 * n), n));
    if (n != 3) matcher.put(1, frame(n, static_cast<int>(10 * n + 300), n));
  }
  for (std::uint64_t n = 1; n <= 5; ++n) {
    const auto set = matcher.take();
    ASSERT_TRUE(set) << n;
    EXPECT_EQ(set->trigger, n);
    EXPECT_EQ(set->matched, n != 3);
    EXPECT_EQ(number(*set, 1), n != 3 ? static_cast<int>(n) : 2) << "held, as it missed one";
    EXPECT_EQ(set->skew, milliseconds(n != 3 ? 300 : 0));
  }
  EXPECT_FALSE(matcher.take());
}

TEST(FrameMatcher, ATriggeredQueueOverflowsCounted) {
  Matcher matcher(1);
  for (std::uint64_t n = 1; n <= 11; ++n) matcher.put(0, frame(n, 0, n));
  EXPECT_EQ(matcher.counts(0).overflowed, 3U);
  for (std::uint64_t n = 4; n <= 11; ++n) EXPECT_EQ(matcher.take().value().trigger, n);
  EXPECT_FALSE(matcher.take());
}

TEST(FrameMatcher, ATriggerMakesOneSetAlsoWhenThePacerComesBackLate) {
  Matcher matcher(2);
  matcher.clear(0);
  matcher.put(1, frame(0, 0, 7));
  ASSERT_TRUE(matcher.take());
  matcher.put(0, frame(0, 0, 7));
  matcher.advance_to(1000);
  EXPECT_FALSE(matcher.take());
  EXPECT_EQ(matcher.counts(0).unmatched, 1U);
  matcher.put(0, frame(1, 10, 8));
  EXPECT_FALSE(matcher.take());
  matcher.put(1, frame(1, 10, 8));
  EXPECT_EQ(matcher.take().value().trigger, 8U);
}

TEST(FrameMatcher, ATriggeredCameraJoinsAFreeRunningOneByTime) {
  Matcher matcher(2);
  matcher.put(1, frame(0, -16));
  matcher.put(1, frame(1, 0));
  matcher.put(0, frame(0, 2, 1));
  const auto set = matcher.take();
  EXPECT_EQ(number(set.value(), 1), 1);
  EXPECT_EQ(set->trigger, 1U);
}

}  // namespace
}  // namespace orbwatch::hal
