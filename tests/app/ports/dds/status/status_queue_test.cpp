// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/status_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace orbwatch::app::dds {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class StatusQueueTest : public testing::Test {
 protected:
  void put(std::uint64_t frame_set, std::uint64_t result) {
    StampedStatus stamped{};
    stamped.status.frame_set = frame_set;
    stamped.status.result = result;
    queue_->put(stamped);
  }
  /// The frame sets of what waits.
  std::vector<std::uint64_t> taken() {
    std::vector<std::uint64_t> frame_sets;
    queue_->take([&](const StampedStatus& s) { frame_sets.push_back(s.status.frame_set); });
    return frame_sets;
  }

  const std::unique_ptr<StatusQueue> queue_ = std::make_unique<StatusQueue>();
};

TEST_F(StatusQueueTest, TheNewestReplacesTheOthers) {
  for (const std::uint64_t frame_set : {1, 2, 3}) put(frame_set, 0);
  EXPECT_THAT(taken(), ElementsAre(3));
  EXPECT_THAT(taken(), IsEmpty());
  EXPECT_EQ(queue_->drops(), 2U);
}

TEST_F(StatusQueueTest, ResultsKeepTheirFrameSetsAndComeBeforeTheNewest) {
  put(11, 1);
  put(12, 1);
  put(13, 2);
  put(14, 2);
  put(15, 2);
  EXPECT_THAT(taken(), ElementsAre(11, 13, 15));
  EXPECT_EQ(queue_->drops(), 2U);
}

TEST_F(StatusQueueTest, NoOlderStatusFollowsAResult) {
  put(10, 0);
  put(11, 1);
  EXPECT_THAT(taken(), ElementsAre(11));
  EXPECT_EQ(queue_->drops(), 1U);
  put(12, 1);
  EXPECT_THAT(taken(), ElementsAre(12));
}

TEST_F(StatusQueueTest, TheOldestOfTooManyResultsIsDropped) {
  for (std::uint64_t n = 1; n <= StatusQueue::kMaxResults + 2; ++n) put(n, n);
  const auto left = taken();
  ASSERT_EQ(left.size(), StatusQueue::kMaxResults);
  EXPECT_EQ(left.front(), 3U);
  EXPECT_EQ(left.back(), StatusQueue::kMaxResults + 2);
  EXPECT_EQ(queue_->drops(), 2U);
}

TEST_F(StatusQueueTest, NothingIsLeftWhenDiscarded) {
  put(1, 1);
  put(2, 1);
  queue_->discard();
  EXPECT_THAT(taken(), IsEmpty());
  EXPECT_EQ(queue_->drops(), 2U);
}

TEST_F(StatusQueueTest, NoResultIsSeenWithAnotherFrameSetWhileBothThreadsWork) {
  constexpr std::uint64_t kSets = 3000, kPeriod = 3;  // every third frame set is a result
  std::jthread sender([this] {
    for (std::uint64_t n = 1; n <= kSets; ++n) put(n, n / kPeriod);
  });
  std::uint64_t frame_set = 0, result = 0, count = 0;
  const auto publish = [&](const StampedStatus& stamped) {
    const Status& status = stamped.status;
    EXPECT_GT(status.frame_set, frame_set);
    if (status.result != result) {
      EXPECT_EQ(status.frame_set, status.result * kPeriod);
    }
    frame_set = status.frame_set;
    result = status.result;
    ++count;
  };
  while (frame_set != kSets) queue_->take(publish);
  sender.join();
  queue_->take(publish);  // an older status may have come while the last result was taken
  EXPECT_EQ(count + queue_->drops(), kSets);
}

}  // namespace
}  // namespace orbwatch::app::dds
