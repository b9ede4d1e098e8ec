// SPDX-License-Identifier: Apache-2.0
#include "app/watch/camera_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <future>
#include <memory>
#include <utility>
#include <vector>

#include "tests/app/watch/two_watched_cameras.h"
#include "tests/proc/align/detect/painted_ball.h"
#include "tests/support/comes_true.h"

namespace orbwatch::app {
namespace {

using CameraWatchTest = tests::TwoWatchedCameras;

TEST_F(CameraWatchTest, WhatIsRecordedOfSeveralCamerasIsOfTheSameMoments) {
  constexpr std::size_t kCount = 5;
  auto recorded = std::async(std::launch::async, [&] {
    return watch->record({0, 1}, kCount, std::chrono::seconds(60), {});
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

/// Asks for pictures of both cameras and shows sets, whose frames have their number in each pixel.
class TogetherTest : public CameraWatchTest {
 protected:
  using Pictures = Result<std::vector<RecordedPicture>>;

  std::future<Pictures> ask() {
    const auto answered = std::make_shared<std::promise<Pictures>>();
    watch->ask_together({0, 1},
                        [answered](Pictures taken) { answered->set_value(std::move(taken)); });
    return answered->get_future();
  }
  /// A set with a new frame of each of `cameras` and a held one of the others.
  void show(const std::vector<std::size_t>& cameras) {
    ++set.id;
    set.stamp = stamp += std::chrono::milliseconds(40);
    set.held.fill(true);
    for (const std::size_t camera : cameras) {
      set.frames[camera] = frame();
      std::memset(set.frames[camera]->memory, static_cast<int>(set.id % 251),
                  set.frames[camera]->capacity);
      set.held[camera] = false;
    }
    watch->accept_frames(set);
  }

  hal::FrameSet set;
};

TEST_F(TogetherTest, PicturesAreOfOneSet) {
  for (int asked = 0; asked < 5; ++asked) {
    auto answer = ask();
    while (answer.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
      show({0});
      show({1});
      show({0, 1});
    }
    const Pictures pictures = answer.get();
    ASSERT_TRUE(pictures) << pictures.error().message;
    ASSERT_EQ(pictures->size(), kCameras);
    const RecordedPicture& first = (*pictures)[0];
    const RecordedPicture& second = (*pictures)[1];
    EXPECT_EQ(first.time, second.time);
    EXPECT_EQ(first.storage[0], second.storage[0]);
    EXPECT_NE(first.storage[0], std::byte{0});
  }
}

TEST_F(TogetherTest, CamerasThatNeverShareASetAreRefused) {
  auto answer = ask();
  for (hal::Clock::duration shown{0}; shown <= FrameSetCopies::kPatience;
       shown += std::chrono::milliseconds(40)) {
    show({set.id % 2});
  }
  const Pictures pictures = answer.get();
  ASSERT_FALSE(pictures);
  EXPECT_EQ(pictures.error().message,
            "no frame set of 3 s has a new picture of each camera: one delivers none, or they are "
            "not exposed together");
  auto next = ask();
  show({0, 1});
  EXPECT_TRUE(next.get()) << "the next one is served";
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

/// A camera that sees a ball of which its rig states an outline that is 5 % too small.
class OutlineTest : public CameraWatchTest {
 protected:
  OutlineTest() {
    optics::RigCamera camera;
    camera.name = "a";
    camera.width = picture.cols;
    camera.height = picture.rows;
    camera.outline = align::kPaintedLimb;
    camera.outline->rx = camera.outline->ry = 0.95 * align::kPaintedLimb.rx;
    camera.distance = 12;
    site.rig.cameras = {camera};
    site.cameras = {{"a", 0, {}}};
    watch.emplace(site, folder.path(), threads, outline_threads);
  }
  /// Shows one picture; the result expires when no one holds it any more.
  std::weak_ptr<const hal::FrameBuffer> give() {
    hal::FrameSet set;
    set.stamp = stamp += std::chrono::milliseconds(100);
    auto buffer = hal::make_frame_pool(PixelFormat::Grey, picture.cols, picture.rows, 1).acquire();
    std::memcpy(buffer->memory, picture.data, picture.total());
    buffer->metadata.exposure_start = stamp;
    const std::weak_ptr<const hal::FrameBuffer> held = buffer;
    set.frames[0] = std::move(buffer);
    watch->accept_frames(set);
    return held;
  }
  /// Shows one picture; returns when no one holds it.
  void show() {
    const auto held = give();
    ASSERT_TRUE(orbwatch::tests::comes_true([&] { return held.expired(); })) << "it is still held";
  }

  const cv::Mat picture = align::painted_ball(align::kPaintedSize, align::kPaintedLimb);
  std::shared_ptr<hal::SharedThreads> threads = hal::SharedThreads::alone();
  std::shared_ptr<hal::SharedThreads> outline_threads = hal::SharedThreads::alone();
};

/// A driver may have two buffers only.
TEST_F(OutlineTest, NoFrameIsHeldWhileTheOutlineIsChecked) {
  std::shared_future<void> may;
  hal::SharedThreads::Work before(outline_threads, [&may] { may.wait(); });
  std::promise<void> check;  // destroyed before the work, which then waits no longer
  may = check.get_future().share();
  before.request();
  for (int n = 0; n < 60; ++n) {
    show();
    ASSERT_FALSE(HasFatalFailure()) << n;
  }
  EXPECT_EQ(watch->figures()[0].alignment, AlignmentLevel::Good) << "the zero is learnt";
  EXPECT_EQ(watch->figures()[0].outline_check, OutlineState::Unknown);
  check.set_value();
  EXPECT_TRUE(orbwatch::tests::comes_true([&] {
    show();
    return watch->figures()[0].outline_check == OutlineState::NotAligned;
  }));
}

/// A camera whose zero is learnt and whose outline is checked.
class FaultTest : public OutlineTest {
 protected:
  void SetUp() override {
    ASSERT_TRUE(orbwatch::tests::comes_true([&] {
      show();
      return watch->figures()[0].outline_check == OutlineState::NotAligned;
    }));
    expect_measured();
  }
  void report(hal::Fault fault) {
    Status status;
    status.cameras[0].fault = fault;
    watch->accept(status);
  }
  void expect_measured() {
    EXPECT_EQ(watch->figures()[0].alignment, AlignmentLevel::Good);
    EXPECT_TRUE(signals::is_valid(watch->figures()[0].drift_error));
    EXPECT_TRUE(watch->drift(0));
  }
  void expect_not_measured(const char* when) {
    const CameraWatchStatus seen = watch->figures()[0];
    EXPECT_FALSE(watch->drift(0)) << when;
    EXPECT_EQ(seen.alignment, AlignmentLevel::NotMeasured) << when;
    EXPECT_FALSE(signals::is_valid(seen.drift_error)) << when;
    EXPECT_FALSE(signals::is_valid(seen.drift_shift)) << when;
    EXPECT_EQ(seen.focus, WatchLevel::NotMeasured) << when;
    EXPECT_FALSE(signals::is_valid(seen.blur)) << when;
    EXPECT_EQ(seen.outline_check, OutlineState::NotAligned) << when << ": it needs no new picture";
    EXPECT_TRUE(signals::is_valid(seen.outline_offset)) << when;
  }
  /// The zero is still known: one picture is enough.
  void expect_measured_by_the_next_picture() {
    EXPECT_TRUE(orbwatch::tests::comes_true([&] {
      show();
      return watch->drift(0).has_value();
    }));
    expect_measured();
  }
};

TEST_F(FaultTest, NothingMeasuredRemainsUntilTheNextPicture) {
  report(hal::Fault::Unplugged);
  expect_not_measured("with the fault");
  report(hal::Fault::None);
  expect_not_measured("before the next picture");
  expect_measured_by_the_next_picture();
}

TEST_F(FaultTest, APictureFromBeforeTheFaultMeasuresNothingAfterIt) {
  std::shared_future<void> may;
  hal::SharedThreads::Work before(threads, [&may] { may.wait(); });
  std::promise<void> look;  // destroyed before the work, which then waits no longer
  may = look.get_future().share();
  before.request();
  std::weak_ptr<const hal::FrameBuffer> held;
  ASSERT_TRUE(orbwatch::tests::comes_true([&] {
    held = give();
    return !held.expired();
  })) << "the look at it waits";
  report(hal::Fault::Stalled);
  report(hal::Fault::None);
  look.set_value();
  ASSERT_TRUE(orbwatch::tests::comes_true([&] { return held.expired(); }));
  expect_not_measured("after the look");
  expect_measured_by_the_next_picture();
}

}  // namespace
}  // namespace orbwatch::app
