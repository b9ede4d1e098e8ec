#include "app/watch/camera_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>

#include "hal/frame/frame_pool.h"
#include "tests/app/watch/rig_with_pose.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

constexpr std::size_t kCameras = 2;

/// Two cameras whose pictures are given by hand.
class CameraWatchTest : public testing::Test {
 protected:
  CameraWatchTest() {
    site.rig = tests::rig_with_pose({120, -500, 430});
    site.site.state_folder = folder.path();
    for (std::size_t i = 0; i < kCameras; ++i) {
      site.rig.cameras.resize(i + 1, site.rig.cameras.front());
      site.rig.cameras[i].name = site.site.cameras.emplace_back().name = i == 0 ? "a" : "b";
      site.rig_cameras.push_back(i);
    }
    watch.emplace(site, hal::SharedThreads::alone());
  }

  hal::Frame frame() {
    auto buffer = hal::make_frame_pool(PixelFormat::Grey, 800, 800, 1).acquire();
    buffer->metadata.exposure_start = stamp;
    return buffer;
  }

  orbwatch::tests::TemporaryFolder folder;
  Resolved site;
  hal::TimePoint stamp{std::chrono::hours(1)};
  std::optional<CameraWatch> watch;
};

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

}  // namespace
}  // namespace orbwatch::app
