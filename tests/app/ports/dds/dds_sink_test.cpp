// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/dds_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "app/ports/dds/status/diagnostics.h"
#include "app/ports/dds/topics/topic_names.h"
#include "hal/frame/frame_pool.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/figures.h"
#include "tests/app/ports/dds/sink_topics.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"

namespace orbwatch::app::dds {
namespace {

using tests::eventually;
using tests::make_view;

class RawStateReader : public tests::TopicReader<ProcessStateMessage> {
 public:
  RawStateReader()
      : TopicReader(orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic("orbwatch"),
                    state_qos()) {}
};

class DdsSinkTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
  }

  /// Passes `view` repeatedly until a sample arrives for which `look` returns true. A topic keeps
  /// no samples for late joiners.
  static bool publish_until(DdsSink& sink, const ViewPtr& view, const ImageReader& reader,
                            const std::function<bool(const ImageMessage&)>& look) {
    return eventually([&] {
      tests::hand_over(sink, view);
      bool seen = false;
      reader.take([&](const ImageMessage& message) { seen = look(message); });
      return seen;
    });
  }
  bool publish_until_any(const ViewPtr& view, const ImageReader& reader) {
    return publish_until(sink_, view, reader, [](const auto&) { return true; });
  }

  tests::DdsNetwork network_;
  DdsSink sink_{settings(), tests::make_names(), nullptr};
};

TEST_F(DdsSinkTest, ColourArrivesBitExact) {
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  ASSERT_TRUE(publish_until(sink_, view, reader, [&](const ImageMessage& message) {
    EXPECT_STREQ(message.header.frame_id, "front");
    EXPECT_STREQ(message.encoding, "rgb8");
    EXPECT_EQ(message.width, 160u);
    EXPECT_EQ(message.height, 90u);
    EXPECT_EQ(message.step, 480u);
    EXPECT_EQ(message.is_bigendian, 0);
    EXPECT_EQ(message.data._length, view->bytes.size());
    EXPECT_EQ(std::memcmp(message.data._buffer, view->bytes.data(), view->bytes.size()), 0);
    const auto expected = hal::to_utc(view->stamp).time_since_epoch();
    EXPECT_LT(std::chrono::abs(since_epoch(message.header.stamp) - expected),
              std::chrono::seconds(1));
    return true;
  }));
}

TEST_F(DdsSinkTest, PaddingOfRowsIsLeftOut) {
  const ImageReader colour("rt/orbwatch/front/image_raw");
  const ImageReader radiometric("rt/orbwatch/front/radiometric/image_raw");
  const auto padded = make_view(kFront, "front", 1, 33, 7, true, 5);
  const auto tight = make_view(kFront, "front", 1, 33, 7, true);
  ASSERT_TRUE(publish_until(sink_, padded, colour, [&](const ImageMessage& message) {
    EXPECT_EQ(message.step, 99u);
    EXPECT_EQ(message.data._length, tight->bytes.size());
    return std::memcmp(message.data._buffer, tight->bytes.data(), tight->bytes.size()) == 0;
  }));
  ASSERT_TRUE(publish_until(sink_, padded, radiometric, [&](const ImageMessage& message) {
    EXPECT_EQ(message.step, 66u);
    EXPECT_EQ(message.data._length, tight->words.size() * 2);
    return std::memcmp(message.data._buffer, tight->words.data(), message.data._length) == 0;
  }));
}

TEST_F(DdsSinkTest, CountsArriveAsMeasuredWithTheStampOfTheColour) {
  const ImageReader colour("rt/orbwatch/front/image_raw");
  const ImageReader radiometric("rt/orbwatch/front/radiometric/image_raw");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight, true);
  TimeMessage stamp{};
  ASSERT_TRUE(publish_until(sink_, view, radiometric, [&](const ImageMessage& message) {
    EXPECT_STREQ(message.header.frame_id, "front");
    EXPECT_STREQ(message.encoding, "mono16");
    EXPECT_EQ(message.step, 320u);
    EXPECT_EQ(message.data._length, view->words.size() * 2);
    EXPECT_EQ(std::memcmp(message.data._buffer, view->words.data(), message.data._length), 0);
    // Written out once, so that the byte order does not depend on memcmp on this host.
    const int value = message.data._buffer[2] | message.data._buffer[3] << 8;
    EXPECT_EQ(value, *view->radiometric.at(1, 0));
    stamp = message.header.stamp;
    return true;
  }));
  ASSERT_TRUE(publish_until(sink_, view, colour, [&](const ImageMessage& message) {
    EXPECT_EQ(since_epoch(message.header.stamp), since_epoch(stamp)) << "one frame set, one stamp";
    return true;
  }));
}

void expect_not_valid(const ComponentMessage& region) {
  for (const signals::SignalInfo& info : signals::kSignals) {
    EXPECT_TRUE(std::isnan(tests::value(region, info.name))) << info.name;
  }
}

TEST_F(DdsSinkTest, WhatIsNotValidStaysSo) {
  Status status;  // before the first frame set: no stamp, no signal
  status.heartbeat = 9;
  status.region_count = 1;
  status.camera_count = 1;
  sink_.accept(status);
  const RawStateReader reader;
  const auto look = [](const ProcessStateMessage& state) {
    EXPECT_EQ(state.heartbeat, 9u);
    EXPECT_EQ(since_epoch(state.header.stamp).count(), 0);
    ASSERT_EQ(tests::of_kind(state, "region").size(), 1u);
    expect_not_valid(tests::of_kind(state, "region")[0]);
    ASSERT_EQ(tests::of_kind(state, "camera").size(), 1u);
    EXPECT_TRUE(std::isnan(tests::value(tests::of_kind(state, "camera")[0], "last_frame_age")));
    ASSERT_EQ(tests::of_kind(state, "health").size(), 1u);
    EXPECT_TRUE(std::isnan(tests::value(tests::of_kind(state, "health")[0], "board_temperature")));
  };
  ASSERT_TRUE(eventually([&] { return reader.take(look); }));
}

TEST_F(DdsSinkTest, StateHasTheStampOfItsImages) {
  const RawStateReader states;
  const ImageReader images("rt/orbwatch/front/image_raw");
  const auto view = make_view(kFront, "front", 5, kWidth, kHeight);
  std::chrono::nanoseconds image_stamp{0};
  ASSERT_TRUE(publish_until(sink_, view, images, [&](const ImageMessage& message) {
    image_stamp = since_epoch(message.header.stamp);
    return true;
  }));
  Status status;
  status.frame_set = 5;
  status.stamp = view->stamp;
  sink_.accept(status);
  ASSERT_TRUE(eventually([&] {
    return states.take([&](const ProcessStateMessage& state) {
      EXPECT_EQ(since_epoch(state.header.stamp), image_stamp);
    });
  }));
}

TEST_F(DdsSinkTest, SelectedTopicFollowsTheStatus) {
  const std::string topic = "rt/orbwatch/selected/image_raw";
  const ImageReader reader(topic);
  const std::array views{make_view(kFront, "front", 1, kWidth, kHeight),
                         make_view(kWide, "wide", 1, kWidth / 2, kHeight / 2)};
  // The sink has processed a view when it has released it.
  const auto idle = [&] { return views[0].use_count() == 1 && views[1].use_count() == 1; };
  Status status;
  for (const std::size_t selected : {kWide, kFront, kWide}) {
    status.selected_view = static_cast<std::uint16_t>(selected);
    sink_.accept(status);
    const View& shown = *views[selected];
    ASSERT_TRUE(publish_until(sink_, views[selected], reader, [&](const ImageMessage& message) {
      return message.header.frame_id == shown.name &&
             message.width == static_cast<std::uint32_t>(shown.picture.width);
    }));
    ASSERT_TRUE(eventually(idle));
    // From here on no sample of the other view may arrive.
    const auto written = of_topic(sink_, topic).written;
    for (int i = 0; i < 3; ++i) {
      tests::hand_over(sink_, views[1 - selected]);
      ASSERT_TRUE(eventually(idle));
    }
    EXPECT_EQ(of_topic(sink_, topic).written, written);
  }
}

TEST_F(DdsSinkTest, UnreadTopicsAreNotWritten) {
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto wide = make_view(kWide, "wide", 1, kWidth, kHeight, true);
  tests::hand_over(sink_, wide);
  ASSERT_TRUE(publish_until_any(make_view(kFront, "front", 1, kWidth, kHeight), reader));
  EXPECT_TRUE(
      eventually([&] { return of_topic(sink_, "rt/orbwatch/front/image_raw").written > 0; }));
  for (const auto* topic : {"rt/orbwatch/wide/image_raw", "rt/orbwatch/wide/image_raw/compressed",
                            "rt/orbwatch/selected/image_raw/compressed"}) {
    EXPECT_GE(of_topic(sink_, topic).unread, 1u) << topic;
    EXPECT_EQ(of_topic(sink_, topic).written, 0u) << topic;
  }
  EXPECT_EQ(wide.use_count(), 1) << "a topic that nobody reads takes no picture";
  EXPECT_EQ(of_topic(sink_, "rt/orbwatch/selected/image_raw").written, 0u);
}

TEST_F(DdsSinkTest, HungReadersCostDropsThatAreCounted) {
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto first = make_view(kFront, "front", 1, kWidth, kHeight);
  ASSERT_TRUE(publish_until_any(first, reader));
  // The sink is idle when it has released the view.
  ASSERT_TRUE(eventually([&] { return first.use_count() == 1; }));
  reader.drain();

  network_.hang_readers(true);
  const auto dropped = [&] { return of_topic(sink_, "rt/orbwatch/front/image_raw").replaced; };
  const auto outcome = [&] { return sum(of_topic(sink_, "rt/orbwatch/front/image_raw")); };
  const auto dropped_before = dropped();
  const auto outcome_before = outcome();
  const auto view = make_view(kFront, "front", 2, 1280, 720);
  std::uint64_t accepted = 0;
  ASSERT_TRUE(eventually([&] {
    tests::hand_over(sink_, view);
    ++accepted;
    return dropped() >= dropped_before + 100;
  }));
  ASSERT_TRUE(eventually([&] { return view.use_count() == 1; })) << "the view must come back";
  EXPECT_EQ(outcome() - outcome_before, accepted);
  EXPECT_FALSE(reader.wait()) << "the readers were not hung";

  network_.hang_readers(false);
  const auto after = make_view(kFront, "front", 3, kWidth, kHeight);
  EXPECT_TRUE(publish_until(sink_, after, reader, [&](const ImageMessage& message) {
    return message.data._length == after->bytes.size() &&
           std::memcmp(message.data._buffer, after->bytes.data(), after->bytes.size()) == 0;
  }));
}

TEST_F(DdsSinkTest, ViewsComeBackWhenWrittenAndWhenStopped) {
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight, true);
  ASSERT_TRUE(publish_until_any(view, reader));
  ASSERT_TRUE(eventually([&] { return view.use_count() == 1; }));
  for (int i = 0; i < 100; ++i) tests::hand_over(sink_, view);
  sink_.stop();
  EXPECT_EQ(view.use_count(), 1);
}

TEST_F(DdsSinkTest, StartsAgainAfterStop) {
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  ASSERT_TRUE(publish_until_any(view, reader));
  sink_.stop();
  sink_.stop();
  const auto stopped = sink_.statistics();
  tests::hand_over(sink_, view);
  sink_.accept(tests::make_status());
  EXPECT_EQ(view.use_count(), 1) << "a stopped sink holds nothing";
  EXPECT_EQ(of_topic(sink_, stopped.topics[0].topic).written, stopped.topics[0].written);

  reader.drain();
  const auto started = sink_.start();
  ASSERT_TRUE(started) << started.error().message;
  EXPECT_TRUE(sink_.start()) << "starting twice does nothing";
  EXPECT_TRUE(publish_until_any(make_view(kFront, "front", 2, kWidth, kHeight), reader));
}

TEST_F(DdsSinkTest, TwoSinksDoNotDisturbEachOther) {
  DdsSink other(settings("cell3/orbwatch"), {{}, {"front"}, {}}, nullptr);
  ASSERT_TRUE(other.start());
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const ImageReader other_reader("rt/cell3/orbwatch/front/image_raw");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  const auto other_view = make_view(kFront, "front", 1, kWidth / 2, kHeight);
  const auto is_of = [](const ViewPtr& expected) {
    return [expected](const ImageMessage& message) {
      EXPECT_EQ(message.width, static_cast<std::uint32_t>(expected->picture.width));
      return true;
    };
  };
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(publish_until(sink_, view, reader, is_of(view)));
    ASSERT_TRUE(publish_until(other, other_view, other_reader, is_of(other_view)));
  }
  other.stop();
  reader.drain();
  EXPECT_TRUE(publish_until(sink_, view, reader, is_of(view)));
}

TEST_F(DdsSinkTest, CompressedIsAJpegOfTheSamePicture) {
  const CompressedReader reader("rt/orbwatch/front/image_raw/compressed");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    std::memset(view->picture.samples<std::uint8_t>().row(y), 10 + 2 * y, 3 * kWidth);
  bool seen = false;
  ASSERT_TRUE(eventually([&] {
    tests::hand_over(sink_, view);
    reader.take([&](const CompressedImageMessage& message) {
      EXPECT_STREQ(message.header.frame_id, "front");
      EXPECT_STREQ(message.format, "rgb8; jpeg compressed bgr8");
      const cv::Mat picture = cv::imdecode(
          cv::Mat(1, static_cast<int>(message.data._length), CV_8UC1, message.data._buffer),
          cv::IMREAD_COLOR);
      ASSERT_EQ(picture.size(), cv::Size(kWidth, kHeight));
      for (int y = 0; y < kHeight; ++y) {
        EXPECT_NEAR(picture.at<cv::Vec3b>(y, kWidth / 2)[1], 10 + 2 * y, 4);
      }
      seen = true;
    });
    return seen;
  }));
  EXPECT_EQ(of_topic(sink_, "rt/orbwatch/front/image_raw").written, 0u) << "nobody reads it";
}

TEST_F(DdsSinkTest, DiagnosticsComeOnceASecond) {
  const tests::TopicReader<DiagnosticsMessage> reader(
      diagnostic_msgs_msg_dds__DiagnosticArray__desc, kDiagnosticsTopic, frame_qos());
  const Status status = tests::make_status();
  std::vector<std::string> names;
  ASSERT_TRUE(eventually([&] {
    sink_.accept(status);
    reader.take([&](const DiagnosticsMessage& message) {
      names.clear();
      for (std::uint32_t i = 0; i < message.status._length; ++i) {
        names.emplace_back(message.status._buffer[i].name);
      }
    });
    return !names.empty();
  }));
  EXPECT_THAT(names, testing::Contains("orbwatch: camera thermal"));
  // The next two are a full second apart, and no other one is sent in between.
  const auto messages = [&] {
    const TopicStatistics topic = of_topic(sink_, kDiagnosticsTopic);
    return topic.written + topic.unread;
  };
  const auto states = [&] { return of_topic(sink_, process_state_topic("orbwatch")).written; };
  const auto messages_before = messages();
  const auto states_before = states();
  ASSERT_TRUE(eventually([&] {
    sink_.accept(status);
    return messages() >= messages_before + 2;
  }));
  EXPECT_GT(states() - states_before, 2 * (messages() - messages_before));
}

TEST_F(DdsSinkTest, OtherTypesOnItsTopicsAreCounted) {
  const Participant participant = Participant::join(tests::DdsNetwork::kReaderDomain).value();
  const Entity topic = make_topic(participant.entity(), sensor_msgs_msg_dds__CompressedImage__desc,
                                  "rt/orbwatch/front/image_raw")
                           .value();
  const Entity reader = make_reader(participant.entity(), topic, frame_qos()).value();
  const Entity writer = make_writer(participant.entity(), topic, frame_qos()).value();
  EXPECT_TRUE(eventually([&] {
    sink_.accept(Status{});
    return sink_.statistics().mistyped == 2;
  }));
}

TEST_F(DdsSinkTest, CamerasPicturesAreSentWhileSomebodyReads) {
  hal::FrameSet set;
  const auto frame = std::make_shared<hal::FrameBuffer>();
  const std::vector<std::byte> samples(64 * 48 * 3 / 2, std::byte{128});
  frame->picture = Picture::contiguous(PixelFormat::Nv12, 64, 48, samples.data(), 64);
  set.frames[1] = frame;
  set.stamp = hal::Clock::now();
  frame->metadata.exposure_start = set.stamp + std::chrono::milliseconds(70);
  sink_.accept_frames(set);
  EXPECT_EQ(frame.use_count(), 2) << "nobody reads it";
  const ImageReader reader("rt/orbwatch/thermal/ball/image_raw");
  bool seen = false;
  ASSERT_TRUE(eventually([&] {
    sink_.accept_frames(set);
    reader.take([&](const ImageMessage& message) {
      EXPECT_STREQ(message.header.frame_id, "thermal");
      const auto exposed = hal::to_utc(frame->metadata.exposure_start).time_since_epoch();
      EXPECT_LT(std::chrono::abs(since_epoch(message.header.stamp) - exposed),
                std::chrono::milliseconds(20))
          << "of its own exposure, not of the set's";
      EXPECT_STREQ(message.encoding, "rgb8");
      EXPECT_EQ(message.width, 64u);
      EXPECT_EQ(message.height, 48u);
      EXPECT_NEAR(message.data._buffer[0], (128 - 16) * 255 / 219, 1);
      seen = true;
    });
    return seen;
  }));
  const auto before = sum(of_topic(sink_, "rt/orbwatch/thermal/ball/image_raw"));
  set.held[1] = true;
  sink_.accept_frames(set);
  EXPECT_EQ(sum(of_topic(sink_, "rt/orbwatch/thermal/ball/image_raw")), before)
      << "it was sent already";
  sink_.stop();  // its thread may use the samples until then
}

/// Readers of a picture's two topics in the sink's own domain, which are called inside its writes
/// and block them until their end.
class HoldingReaders {
 public:
  explicit HoldingReaders(const std::string& raw)
      : participant_(Participant::join(tests::DdsNetwork::kSinkDomain).value()),
        raw_(read(sensor_msgs_msg_dds__Image__desc, raw)),
        compressed_(read(sensor_msgs_msg_dds__CompressedImage__desc, compressed_topic(raw))) {}
  ~HoldingReaders() {
    ended_ = true;
    ended_.notify_all();
  }

  /// Number of blocked writes.
  int held() const { return held_; }

 private:
  Entity read(const dds_topic_descriptor_t& type, const std::string& name) {
    const Entity& topic =
        topics_.emplace_back(make_topic(participant_.entity(), type, name).value());
    show_order_of_calls();
    const Listener listener(dds_create_listener(this));
    dds_lset_data_available(listener.get(), hold);
    return make_reader(participant_.entity(), topic, frame_qos(), listener.get()).value();
  }
  static void hold(dds_entity_t, void* argument) {
    auto& self = *static_cast<HoldingReaders*>(argument);
    show_order_of_calls();
    ++self.held_;
    self.ended_.wait(false);
    show_order_of_calls();
  }

  std::atomic<int> held_ = 0;
  std::atomic<bool> ended_ = false;
  Participant participant_;
  std::vector<Entity> topics_;
  Entity raw_;
  Entity compressed_;
};

class BlockedWrites : public DdsSinkTest, public testing::WithParamInterface<int> {};

/// With a thread for each topic no buffer is held. With one thread the other topic's picture waits
/// in the one buffer reserved for that topic.
TEST_P(BlockedWrites, HoldNoBufferOfACameraThemselves) {
  const int threads = GetParam();
  DdsSink sink(settings(), tests::make_names(), nullptr, network_addresses,
               std::make_shared<CommandRecord>(),
               std::make_shared<hal::SharedThreads>("test", hal::ThreadRole::Background, threads));
  ASSERT_TRUE(sink.start());
  const std::string raw = "rt/orbwatch/thermal/ball/image_raw";
  const HoldingReaders readers(raw);
  // RGB without padding, which could be passed to DDS in place.
  hal::FramePool pool = hal::make_frame_pool(PixelFormat::Rgb, 64, 48);
  hal::FrameSet set;
  const auto expose = [&] {
    const auto buffer = pool.acquire();
    ASSERT_TRUE(buffer);
    set.stamp = hal::Clock::now();
    buffer->metadata.exposure_start = set.stamp;
    set.frames[1] = buffer;
    sink.accept_frames(set);
    set.frames[1].reset();
  };
  ASSERT_TRUE(eventually([&] {
    expose();
    return HasFatalFailure() || readers.held() == threads;
  }));
  for (int n = 0; n < 3; ++n) expose();
  const auto replaced = [&] {
    return of_topic(sink, raw).replaced + of_topic(sink, compressed_topic(raw)).replaced;
  };
  const auto before = replaced();
  for (int n = 0; n < 3; ++n) {
    expose();
    EXPECT_EQ(pool.lent(), 2U - static_cast<std::size_t>(threads));
  }
  EXPECT_EQ(replaced(), before + 6) << "of both topics";
}

INSTANTIATE_TEST_SUITE_P(Threads, BlockedWrites, testing::Values(1, 2));

TEST_F(DdsSinkTest, ViewsWithoutATopicAreCounted) {
  tests::hand_over(sink_, make_view(2, "third", 1, kWidth, kHeight));
  EXPECT_EQ(sink_.statistics().unknown_views, 1u);
}

}  // namespace
}  // namespace orbwatch::app::dds
