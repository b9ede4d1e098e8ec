#include "app/watch/camera_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <string>
#include <utility>

#include "app/alignment/alignment_pictures.h"
#include "hal/frame/frame_pool.h"
#include "tests/app/alignment/rig_with_pose.h"
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

/// One that is unplugged beside one that delivers.
class AlignmentPicturesTest : public CameraWatchTest {
 protected:
  AlignmentPicturesTest() : pictures(*watch) {}
  ~AlignmentPicturesTest() override {
    watch->stop();
    pictures.stop();
  }

  Result<> ask(
      std::size_t camera, AlignmentSource::IsWanted is_wanted = [] { return true; }) {
    const auto ball = optics::ball_projection(site.rig, site.rig.cameras[camera]);
    return pictures.request(
        {camera, {}, false, {}}, ball.value(), [this](const Result<std::string>&) { ++made; },
        std::move(is_wanted));
  }
  void show(std::size_t camera) {
    hal::FrameSet set;
    set.stamp = stamp += std::chrono::milliseconds(40);
    set.frames[camera] = frame();
    watch->accept_frames(set);
  }

  std::atomic<std::size_t> made{0};
  AlignmentPictures pictures;
};

TEST_F(AlignmentPicturesTest, OfASilentCameraTakeNoPlaceOfAnothers) {
  for (std::size_t i = 0; i < AlignmentPictures::kMostWaiting; ++i) ASSERT_TRUE(ask(1));
  EXPECT_FALSE(ask(1)) << "a camera has so many";
  for (std::size_t i = 0; i < 3; ++i) ASSERT_TRUE(ask(0));
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (made < 3 && std::chrono::steady_clock::now() < give_up) show(0);
  EXPECT_EQ(made, 3U);
}

TEST_F(AlignmentPicturesTest, ThatNobodyWaitsForAnyMoreAreDropped) {
  std::atomic<bool> is_wanted = true;
  for (std::size_t i = 0; i < AlignmentPictures::kMostWaiting; ++i) {
    ASSERT_TRUE(ask(1, [&] { return is_wanted.load(); }));
  }
  is_wanted = false;  // their requests were answered by the deadline
  EXPECT_TRUE(ask(1));
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (made < 1 && std::chrono::steady_clock::now() < give_up) show(1);
  EXPECT_TRUE(ask(1));
  while (made < 2 && std::chrono::steady_clock::now() < give_up) show(1);
  EXPECT_EQ(made, 2U) << "none of the sixteen";
}

TEST_F(AlignmentPicturesTest, OfACameraWithAFaultAreRefusedAtOnce) {
  Status status;
  status.camera_count = kCameras;
  status.cameras[1].fault = hal::Fault::Unplugged;
  watch->accept(status);
  EXPECT_TRUE(ask(0));
  const auto refused = ask(1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "there is no picture: camera is not connected, or cannot be opened");
  status.cameras[1].fault = hal::Fault::None;
  watch->accept(status);
  EXPECT_TRUE(ask(1));
}

TEST_F(CameraWatchTest, SaysThatACameraIsNotRegistered) {
  EXPECT_EQ(watch->figures()[1].alignment, AlignmentLevel::NotMeasured);
  site.rig.cameras[1].is_registered = false;
  for (const bool is_watched : {true, false}) {
    site.site.cameras[1].watch.enabled = is_watched;
    watch.emplace(site, hal::SharedThreads::alone());
    EXPECT_EQ(watch->figures()[0].alignment, AlignmentLevel::NotMeasured);
    EXPECT_EQ(watch->figures()[1].alignment, AlignmentLevel::NotRegistered);
  }
}

}  // namespace
}  // namespace orbwatch::app
