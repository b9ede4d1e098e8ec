// SPDX-License-Identifier: Apache-2.0
#include "app/watch/camera_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>

#include "tests/app/watch/two_watched_cameras.h"

namespace orbwatch::app {
namespace {

using CameraWatchTest = tests::TwoWatchedCameras;

TEST_F(CameraWatchTest, WhatIsRecordedOfSeveralCamerasIsOfTheSameMoments) {
  constexpr std::size_t kCount = 5;
  auto recorded = std::async(std::launch::async, [&] {
    return watch->record({0, 1}, kCount, std::chrono::seconds(60));
  });
  for (hal::FrameSet set;
       recorded.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready;) {
    ++set.id;
    set.stamp = stamp += std::chrono::milliseconds(40);
    set.frames = {};
    for (std::size_t i = 0; i < kCameras; ++i) {
      // Only every third set has new pictures of both.
      if (set.id % 3 == 0 || set.id % 3 == i + 1) set.frames[i] = frame();
    }
    watch->accept_frames(set);
  }
  const auto records = recorded.get();
  ASSERT_TRUE(records) << records.error().message;
  // The first may have been taken before the other camera was recorded, too.
  std::size_t together = 0;
  for (const RecordedPicture& one : (*records)[0]) {
    together += std::ranges::count((*records)[1], one.time, &RecordedPicture::time);
  }
  EXPECT_GE(together, kCount - 1);
}

TEST_F(CameraWatchTest, SaysThatACameraIsNotRegistered) {
  EXPECT_EQ(watch->figures()[1].alignment, AlignmentLevel::NotMeasured);
  site.rig.cameras[1].is_registered = false;
  for (const bool is_watched : {true, false}) {
    site.cameras[1].watch.enabled = is_watched;
    watch_anew();
    EXPECT_EQ(watch->figures()[0].alignment, AlignmentLevel::NotMeasured);
    EXPECT_EQ(watch->figures()[1].alignment, AlignmentLevel::NotRegistered);
  }
}

}  // namespace
}  // namespace orbwatch::app
