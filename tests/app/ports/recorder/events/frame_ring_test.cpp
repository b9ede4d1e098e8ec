// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/frame_ring.h"

#include <gtest/gtest.h>

#include "tests/app/ports/recorder/events/painted_frame.h"

namespace orbwatch::app::recorder {
namespace {

using std::chrono::milliseconds;
using tests::painted;
using tests::painted_frame;

constexpr int kWidth = 32, kHeight = 16;
constexpr std::size_t kBytes = 2 * kWidth * kHeight;

hal::TimePoint at(std::uint64_t number) {
  return hal::TimePoint(std::chrono::hours(1)) + milliseconds(10) * number;
}

bool put(FrameRing& ring, std::uint64_t number, int width = kWidth) {
  const hal::Frame frame = painted_frame(number, 0, at(number), width, kHeight);
  return ring.put({0,
                   number,
                   number,
                   at(number),
                   at(number),
                   {width, kHeight, {0, 0, width, kHeight}},
                   frame->picture});
}

/// Reads all that a window has; fails for a picture that its number did not paint.
std::vector<std::uint64_t> read_all(FrameRing& ring, std::size_t window) {
  std::vector<std::uint64_t> numbers;
  while (const auto frame = ring.next(window)) {
    const auto samples = frame->picture.samples<std::uint16_t>();
    for (int y = 0; y < samples.height; ++y) {
      for (int x = 0; x < samples.width; ++x) {
        EXPECT_EQ(samples.row(y)[x], painted(frame->frame_set, 0, x, y));
      }
    }
    numbers.push_back(frame->frame_set);
    ring.pass(window);
  }
  return numbers;
}

std::vector<std::uint64_t> from_to(std::uint64_t first, std::uint64_t last) {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t n = first; n <= last; ++n) numbers.push_back(n);
  return numbers;
}

TEST(FrameRing, AWindowHasItsPicturesFromBeforeAndAfterwards) {
  FrameRing ring(20 * kBytes, kBytes);
  for (std::uint64_t n = 1; n <= 50; ++n) EXPECT_TRUE(put(ring, n));
  const auto window = ring.hold(at(40), at(55));
  ASSERT_TRUE(window);
  EXPECT_TRUE(window->is_whole);
  EXPECT_EQ(read_all(ring, window->number), from_to(40, 50));
  for (std::uint64_t n = 51; n <= 60; ++n) EXPECT_TRUE(put(ring, n));
  EXPECT_FALSE(ring.is_over(window->number));
  ring.close(window->number);
  EXPECT_EQ(read_all(ring, window->number), from_to(51, 55));
  EXPECT_TRUE(ring.is_over(window->number));
}

TEST(FrameRing, PicturesThatWereReplacedAreMissingAndSaidToBe) {
  FrameRing ring(20 * kBytes, kBytes);
  for (std::uint64_t n = 1; n <= 50; ++n) put(ring, n);
  const auto window = ring.hold(at(10), at(50));
  ASSERT_TRUE(window);
  EXPECT_FALSE(window->is_whole);
  EXPECT_EQ(read_all(ring, window->number), from_to(31, 50));
}

TEST(FrameRing, WhatAWindowHoldsIsNotReplacedAndTheNewOneIsLostAndCounted) {
  FrameRing ring(20 * kBytes, kBytes);
  for (std::uint64_t n = 1; n <= 20; ++n) put(ring, n);
  const auto window = ring.hold(at(11), at(1000));
  ASSERT_TRUE(window);
  for (std::uint64_t n = 21; n <= 30; ++n) EXPECT_TRUE(put(ring, n)) << "1 to 10 were free";
  for (std::uint64_t n = 31; n <= 45; ++n) EXPECT_FALSE(put(ring, n));
  EXPECT_EQ(ring.use().lost, 15U);
  EXPECT_EQ(ring.use().bytes, 20 * kBytes);
  EXPECT_FALSE(ring.hold(at(40), at(50))->is_whole) << "31 to 45 are missing";
  EXPECT_TRUE(ring.hold(at(46), at(50))->is_whole);
  EXPECT_EQ(read_all(ring, window->number), from_to(11, 30));
  EXPECT_TRUE(put(ring, 46)) << "what was read makes room";
  EXPECT_EQ(read_all(ring, window->number), from_to(46, 46));
}

TEST(FrameRing, EachWindowCountsThePicturesThatItLacks) {
  FrameRing ring(20 * kBytes, kBytes);
  for (std::uint64_t n = 1; n <= 20; ++n) put(ring, n);
  const auto early = ring.hold(at(1), at(24));
  const auto late = ring.hold(at(23), at(30));
  ASSERT_TRUE(early && late);
  for (std::uint64_t n = 21; n <= 40; ++n) EXPECT_FALSE(put(ring, n));
  EXPECT_EQ(ring.lost_of(early->number), 4U);
  EXPECT_EQ(ring.lost_of(late->number), 8U);
  EXPECT_EQ(ring.use().lost, 20U);
  ring.release(early->number);
  ring.close(early->number);
  const auto next = ring.hold(at(41), at(50));
  ASSERT_TRUE(next);
  EXPECT_EQ(next->number, early->number);
  EXPECT_EQ(ring.lost_of(next->number), 0U);
}

TEST(FrameRing, OverlappingWindowsShareTheirPictures) {
  FrameRing ring(40 * kBytes, kBytes);
  for (std::uint64_t n = 1; n <= 20; ++n) put(ring, n);
  const auto early = ring.hold(at(5), at(25));
  const auto late = ring.hold(at(15), at(30));
  ASSERT_TRUE(early && late);
  for (std::uint64_t n = 21; n <= 35; ++n) put(ring, n);
  EXPECT_EQ(read_all(ring, late->number), from_to(15, 30));
  EXPECT_EQ(read_all(ring, early->number), from_to(5, 25));
}

TEST(FrameRing, AWindowIsFreeOnceItIsClosedAndReleased) {
  FrameRing ring(4 * kBytes, kBytes);
  for (std::size_t n = 0; n < FrameRing::kMostWindows; ++n) EXPECT_TRUE(ring.hold(at(1), at(2)));
  EXPECT_FALSE(ring.hold(at(1), at(2)));
  ring.release(3);
  EXPECT_FALSE(ring.extend(3, at(9))) << "nobody reads it";
  EXPECT_FALSE(ring.hold(at(1), at(2))) << "the pipeline knows it still";
  ring.close(3);
  EXPECT_TRUE(ring.hold(at(1), at(2)));
}

TEST(FrameRing, PicturesOfAnySizeStayWholeAroundTheEndOfTheMemory) {
  FrameRing ring(10 * kBytes + 100, 64);
  const auto window = ring.hold(at(1), at(1000));
  ASSERT_TRUE(window);
  std::vector<std::uint64_t> read;
  for (std::uint64_t n = 1; n <= 1000; ++n) {
    ASSERT_TRUE(put(ring, n, 2 + static_cast<int>(n * 7 % 90)));
    if (n % 3 != 0) continue;
    for (const std::uint64_t number : read_all(ring, window->number)) read.push_back(number);
  }
  for (const std::uint64_t number : read_all(ring, window->number)) read.push_back(number);
  EXPECT_EQ(read, from_to(1, 1000));
}

TEST(FrameRing, APictureThatIsLargerThanTheRingIsLost) {
  FrameRing ring(kBytes / 2, 64);
  EXPECT_FALSE(put(ring, 1));
  EXPECT_EQ(ring.use().lost, 1U);
}

}  // namespace
}  // namespace orbwatch::app::recorder
