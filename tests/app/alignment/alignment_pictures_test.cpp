// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_pictures.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <utility>

#include "tests/app/watch/two_watched_cameras.h"

namespace orbwatch::app {
namespace {

/// One that is unplugged beside one that delivers.
class AlignmentPicturesTest : public tests::TwoWatchedCameras {
 protected:
  AlignmentPicturesTest() : pictures(*watch) {}
  ~AlignmentPicturesTest() override {
    watch->stop();
    pictures.stop();
  }

  Result<> ask(
      std::size_t camera, AlignmentSource::IsWanted is_wanted = [] { return true; }) {
    return pictures.request(
        {camera, {}, false, {}}, {ball(camera)},
        [this](const Result<AlignmentJpegs>& jpegs) {
          if (jpegs) made_of = jpegs->stamp;
          on_made();
          ++made;
        },
        std::move(is_wanted));
  }
  /// A pair of the first camera's picture and that of the second one.
  Result<> ask_pair(AlignmentSource::OnPictures on_pictures) {
    return pictures.request({1, {}, false, {}, true}, {ball(0), ball(1)}, std::move(on_pictures),
                            [] { return true; });
  }
  optics::BallProjection ball(std::size_t camera) const {
    return optics::ball_projection(site.rig, site.rig.cameras[camera]).value();
  }
  void show(std::size_t camera) {
    hal::FrameSet set;
    set.stamp = stamp += std::chrono::milliseconds(40);
    set.frames[camera] = frame();
    watch->accept_frames(set);
  }

  std::function<void()> on_made = [] {};
  std::atomic<std::size_t> made{0};
  hal::TimePoint made_of;  ///< of the newest picture; read after `made`
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

TEST_F(AlignmentPicturesTest, OneAskedForWhileAnotherIsMadeIsMadeOfTheNextFrame) {
  on_made = [this] {
    if (made == 0) {
      EXPECT_TRUE(ask(0));
    }
  };
  ASSERT_TRUE(ask(0));
  const auto begin = stamp, give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (made < 2 && std::chrono::steady_clock::now() < give_up) show(0);
  EXPECT_EQ(made, 2U);
  EXPECT_GT(made_of, begin + std::chrono::milliseconds(40)) << "the first one's";
  EXPECT_LE(made_of, stamp);
}

TEST_F(AlignmentPicturesTest, APairIsOfTheSetThatHasBoth) {
  std::promise<Result<AlignmentJpegs>> made_pair;
  ASSERT_TRUE(ask_pair([&](Result<AlignmentJpegs> pair) { made_pair.set_value(std::move(pair)); }));
  show(0);
  show(1);
  hal::FrameSet set;
  set.stamp = stamp += std::chrono::milliseconds(40);
  set.frames[0] = frame();
  set.frames[1] = frame();
  watch->accept_frames(set);
  const auto pair = made_pair.get_future().get();
  ASSERT_TRUE(pair) << pair.error().message;
  EXPECT_EQ(pair->files.size(), 2U);
  EXPECT_EQ(pair->stamp, set.stamp);
}

TEST_F(AlignmentPicturesTest, APairNeedsBothCameras) {
  Status status;
  status.camera_count = kCameras;
  status.cameras[0].fault = hal::Fault::Unplugged;
  watch->accept(status);
  const auto refused = ask_pair([](const Result<AlignmentJpegs>&) {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "first camera: there is no picture: camera is not connected, or cannot be opened");
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

}  // namespace
}  // namespace orbwatch::app
