// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/pictures/camera_info.h"
#include "app/ports/dds/topics/topic_names.h"
#include "hal/frame/frame_pool.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/offering_sink.h"
#include "tests/app/ports/dds/sink_topics.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"

namespace orbwatch::app::dds {
namespace {

using tests::eventually;
using tests::make_view;

/// A camera_info and the picture beside it.
struct InfoBeside {
  explicit InfoBeside(const std::string& raw)
      : name(raw),
        infos(sensor_msgs_msg_dds__CameraInfo__desc, camera_info_topic(raw), frame_qos()),
        images(raw) {}

  void take() {
    infos.take([&](const CameraInfoMessage& message) {
      info_stamps.push_back(since_epoch(message.header.stamp));
      frame_id = message.header.frame_id;
      width = message.width;
      focal_length = message.k[0];
      model = message.distortion_model;
    });
    images.take([&](const ImageMessage& message) {
      image_stamps.push_back(since_epoch(message.header.stamp));
    });
  }
  bool have_met() const {
    return std::ranges::find_first_of(info_stamps, image_stamps) != info_stamps.end();
  }

  std::string name;
  tests::TopicReader<CameraInfoMessage> infos;
  ImageReader images;
  std::vector<std::chrono::nanoseconds> info_stamps, image_stamps;
  std::string frame_id, model;
  std::uint32_t width = 0;
  double focal_length = 0;
};

TEST(CameraInfoTopics, EachImageTopicOfAPerspectiveViewHasItsCameraInfoBesideIt) {
  const tests::DdsNetwork network;
  ASSERT_TRUE(network.valid());
  DdsSink sink(settings(), tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  InfoBeside own(image_topic("orbwatch", "front")),
      measured(radiometric_topic("orbwatch", "front")),
      selected(image_topic("orbwatch", kSelectedView));
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight, true);
  view->spec = {optics::ViewKind::Perspective, {}, 90, {}, kWidth, kHeight};
  Status status;
  status.selected_view = kFront;
  status.stamp = view->stamp;
  for (InfoBeside* beside : {&own, &measured, &selected}) {
    EXPECT_TRUE(eventually([&] {
      sink.accept(status);
      tests::hand_over(sink, view);
      beside->take();
      return beside->have_met();
    })) << beside->name;
    EXPECT_EQ(beside->frame_id, "front") << beside->name;
    EXPECT_EQ(beside->width, static_cast<std::uint32_t>(kWidth)) << beside->name;
    EXPECT_NEAR(beside->focal_length, kWidth / 2.0, 1e-9) << "tan 45 degrees";
  }
}

TEST(CameraInfoTopics, TheCameraInfoOfAViewIsWrittenWithoutAStatus) {
  const tests::DdsNetwork network;
  ASSERT_TRUE(network.valid());
  DdsSink sink(settings(), tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  InfoBeside front(image_topic("orbwatch", "front"));
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  view->spec = {optics::ViewKind::Perspective, {}, 90, {}, kWidth, kHeight};
  ASSERT_TRUE(eventually([&] {  // the first views are passed before the reader matches
    tests::hand_over(sink, view);
    front.take();
    return !front.info_stamps.empty();
  }));
  const auto before = front.info_stamps.back();
  view->stamp += std::chrono::seconds(1);
  tests::hand_over(sink, view);
  EXPECT_TRUE(eventually([&] {
    front.take();
    return front.info_stamps.back() > before;
  })) << "of a view passed once";
}

TEST(CameraInfoTopics, ACameraWithAKnownLensHasItsCameraInfoBesideItsPicture) {
  const tests::DdsNetwork network;
  ASSERT_TRUE(network.valid());
  constexpr std::size_t kThermal = 1;
  std::vector<PublishedCamera> cameras(2);
  cameras[kThermal].lens = optics::Intrinsics{
      64, 48, 100, 100, 31, 23, optics::Distortion::Fisheye, {0.1, -0.02, 1e-3, 2e-3}};
  DdsSink sink = tests::sink_offering(settings(), {}, cameras);
  ASSERT_TRUE(sink.start());
  const std::vector<std::byte> samples(64 * 48 * 3 / 2, std::byte{128});
  const auto frame = std::make_shared<hal::FrameBuffer>();
  frame->picture = Picture::contiguous(PixelFormat::Nv12, 64, 48, samples.data(), 64);
  hal::FrameSet set;
  set.frames[0] = set.frames[1] = frame;
  set.stamp = hal::Clock::now();
  frame->metadata.exposure_start = set.stamp + std::chrono::milliseconds(70);
  InfoBeside thermal(ball_topic("orbwatch", "thermal"));
  EXPECT_TRUE(eventually([&] {
    sink.accept_frames(set);
    sink.accept(Status{});
    thermal.take();
    return thermal.have_met();
  }));
  EXPECT_EQ(thermal.frame_id, "thermal");
  EXPECT_EQ(thermal.model, "equidistant");
  const auto topics = sink.statistics().topics;
  EXPECT_EQ(std::ranges::find(topics, camera_info_topic(ball_topic("orbwatch", "colour")),
                              &TopicStatistics::topic),
            topics.end())
      << "its lens is not known";
}

}  // namespace
}  // namespace orbwatch::app::dds
