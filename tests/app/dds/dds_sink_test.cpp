#include "app/dds/dds_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

#include "app/dds/topic_names.h"
#include "tests/app/dds/dds_network.h"
#include "tests/app/dds/test_status.h"
#include "tests/app/dds/test_views.h"
#include "tests/app/dds/topic_reader.h"

namespace orbwatch::app {
namespace {

using tests::eventually;
using tests::make_view;

constexpr int kWidth = 160;
constexpr int kHeight = 90;
constexpr std::size_t kFront = 0;
constexpr std::size_t kWide = 1;

class ImageReader : public tests::TopicReader<ImageMessage> {
 public:
  explicit ImageReader(const std::string& topic)
      : TopicReader(sensor_msgs_msg_dds__Image__desc, topic, frame_qos()) {}
};

class StateReader : public tests::TopicReader<ProcessStateMessage> {
 public:
  StateReader()
      : TopicReader(orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic("orbwatch"),
                    state_qos()) {}
};

DdsSettings settings(std::string prefix = "orbwatch") {
  return {.enabled = true, .domain = tests::DdsNetwork::kSinkDomain, .prefix = std::move(prefix)};
}

TopicStatistics of_topic(const DdsSink& sink, const std::string& topic) {
  const auto statistics = sink.statistics();
  const auto found = std::ranges::find(statistics.topics, topic, &TopicStatistics::topic);
  if (found != statistics.topics.end()) return *found;
  ADD_FAILURE() << "no statistics of " << topic;
  return {};
}

std::uint64_t sum(const TopicStatistics& topic) {
  return topic.written + topic.unread + topic.blocked + topic.failed;
}

class DdsSinkTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
  }

  /// Hands `view` over again and again until a sample for which `look` returns true has arrived.
  /// A topic keeps nothing for readers that match later.
  static bool publish_until(DdsSink& sink, const ViewPtr& view, const ImageReader& reader,
                            const std::function<bool(const ImageMessage&)>& look) {
    return eventually([&] {
      sink.accept(view);
      bool seen = false;
      reader.take([&](const ImageMessage& message) { seen = look(message); });
      return seen;
    });
  }
  bool publish_until_any(const ViewPtr& view, const ImageReader& reader) {
    return publish_until(sink_, view, reader, [](const auto&) { return true; });
  }

  tests::DdsNetwork network_;
  DdsSink sink_{settings(), {"front", "wide"}};
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
    // Spelt out once, so that the byte order does not rest on memcmp of the same host.
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

void expect_same_signals(const ProcessStateMessage& state, const signals::Signals& expected) {
#define ORBWATCH_EXPECT(name, unit, scale, minimum, maximum, description) \
  EXPECT_EQ(state.signals.name, expected.name) << #name;
  ORBWATCH_SIGNALS(ORBWATCH_EXPECT)
#undef ORBWATCH_EXPECT
}

void expect_no_signals(const ProcessStateMessage& state) {
#define ORBWATCH_EXPECT(name, unit, scale, minimum, maximum, description) \
  EXPECT_TRUE(std::isnan(state.signals.name)) << #name;
  ORBWATCH_SIGNALS(ORBWATCH_EXPECT)
#undef ORBWATCH_EXPECT
}

void expect_same_cameras(const ProcessStateMessage& state, const Status& status) {
  ASSERT_EQ(state.cameras._length, status.camera_count);
  for (std::size_t i = 0; i < status.camera_count; ++i) {
    const auto& camera = state.cameras._buffer[i];
    EXPECT_EQ(camera.fault, static_cast<int>(status.cameras[i].fault));
    EXPECT_EQ(camera.frames, status.cameras[i].frames);
    EXPECT_EQ(camera.lost, status.cameras[i].lost);
    EXPECT_EQ(camera.dropped, status.cameras[i].dropped);
    EXPECT_EQ(camera.frames_per_second, status.cameras[i].frames_per_second);
    EXPECT_EQ(camera.latency_p50_ms, status.cameras[i].latency_p50_ms);
    EXPECT_EQ(camera.latency_p99_ms, status.cameras[i].latency_p99_ms);
    EXPECT_EQ(camera.triggers, status.cameras[i].triggers);
    EXPECT_EQ(camera.missed, status.cameras[i].missed);
  }
}

void expect_same_views(const ProcessStateMessage& state, const Status& status) {
  ASSERT_EQ(state.views._length, status.view_count);
  for (std::size_t i = 0; i < status.view_count; ++i) {
    const auto& view = state.views._buffer[i];
    EXPECT_STREQ(view.name, i == kFront ? "front" : "wide");
    EXPECT_EQ(view.published, status.views[i].published);
    EXPECT_EQ(view.skipped, status.views[i].skipped);
    EXPECT_EQ(view.frames_per_second, status.views[i].frames_per_second);
    EXPECT_EQ(view.latency_p50_ms, status.views[i].latency_p50_ms);
    EXPECT_EQ(view.latency_p99_ms, status.views[i].latency_p99_ms);
  }
}

TEST_F(DdsSinkTest, StateRoundTripsForALateJoiner) {
  const Status status = tests::make_status();
  sink_.accept(status);
  ASSERT_TRUE(
      eventually([&] { return of_topic(sink_, "rt/orbwatch/process_state").written == 1; }));

  const StateReader late;
  const auto look = [&](const ProcessStateMessage& state) {
    const auto expected = hal::to_utc(status.stamp).time_since_epoch();
    EXPECT_LT(std::chrono::abs(since_epoch(state.stamp) - expected), std::chrono::seconds(1));
    EXPECT_EQ(state.frame_set, status.frame_set);
    EXPECT_EQ(state.system_state, 2);
    EXPECT_EQ(state.heartbeat, status.heartbeat);
    EXPECT_EQ(state.selected_view, 1u);
    EXPECT_EQ(state.overruns, 3u);
    EXPECT_EQ(state.unmatched, 4u);
    EXPECT_EQ(state.load, 0.625);
    expect_same_signals(state, status.signals);
    expect_same_cameras(state, status);
    expect_same_views(state, status);
  };
  ASSERT_TRUE(eventually([&] { return late.take(look); }));
}

TEST_F(DdsSinkTest, WhatIsNotValidStaysSo) {
  Status status;  // before the first frame set: no stamp, no signal
  status.heartbeat = 9;
  sink_.accept(status);
  const StateReader reader;
  const auto look = [](const ProcessStateMessage& state) {
    EXPECT_EQ(state.heartbeat, 9u);
    EXPECT_EQ(since_epoch(state.stamp).count(), 0);
    expect_no_signals(state);
  };
  ASSERT_TRUE(eventually([&] { return reader.take(look); }));
}

TEST_F(DdsSinkTest, StateHasTheStampOfItsImages) {
  const StateReader states;
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
      EXPECT_EQ(since_epoch(state.stamp), image_stamp);
    });
  }));
}

TEST_F(DdsSinkTest, SelectedTopicFollowsTheStatus) {
  const std::string topic = "rt/orbwatch/selected/image_raw";
  const ImageReader reader(topic);
  const std::array views{make_view(kFront, "front", 1, kWidth, kHeight),
                         make_view(kWide, "wide", 1, kWidth / 2, kHeight / 2)};
  // The sink has dealt with a view when it has let go of it.
  const auto idle = [&] { return views[0].use_count() == 1 && views[1].use_count() == 1; };
  Status status;
  for (const std::size_t selected : {kWide, kFront, kWide}) {
    status.selected_view = selected;
    sink_.accept(status);
    const View& shown = *views[selected];
    ASSERT_TRUE(publish_until(sink_, views[selected], reader, [&](const ImageMessage& message) {
      return message.header.frame_id == shown.name &&
             message.width == static_cast<std::uint32_t>(shown.colour.width);
    }));
    ASSERT_TRUE(eventually(idle));
    // From here on nothing of the other view may come.
    const auto written = of_topic(sink_, topic).written;
    for (int i = 0; i < 3; ++i) {
      sink_.accept(views[1 - selected]);
      ASSERT_TRUE(eventually(idle));
    }
    EXPECT_EQ(of_topic(sink_, topic).written, written);
  }
}

TEST_F(DdsSinkTest, UnreadTopicsAreNotWritten) {
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto wide = make_view(kWide, "wide", 1, kWidth, kHeight, true);
  sink_.accept(wide);
  ASSERT_TRUE(publish_until_any(make_view(kFront, "front", 1, kWidth, kHeight), reader));
  EXPECT_TRUE(
      eventually([&] { return of_topic(sink_, "rt/orbwatch/front/image_raw").written > 0; }));
  for (const auto* topic :
       {"rt/orbwatch/wide/image_raw", "rt/orbwatch/wide/radiometric/image_raw"}) {
    ASSERT_TRUE(eventually([&] { return of_topic(sink_, topic).unread == 1; })) << topic;
    EXPECT_EQ(of_topic(sink_, topic).written, 0u) << topic;
  }
  EXPECT_EQ(of_topic(sink_, "rt/orbwatch/selected/image_raw").written, 0u);
}

TEST_F(DdsSinkTest, HungReadersCostDropsThatAreCounted) {
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto first = make_view(kFront, "front", 1, kWidth, kHeight);
  ASSERT_TRUE(publish_until_any(first, reader));
  // The sink is idle when it has let go of the view.
  ASSERT_TRUE(eventually([&] { return first.use_count() == 1; }));
  reader.drain();

  network_.hang_readers(true);
  const auto dropped = [&] { return sink_.statistics().dropped_views[kFront]; };
  const auto outcome = [&] { return sum(of_topic(sink_, "rt/orbwatch/front/image_raw")); };
  const auto dropped_before = dropped();
  const auto outcome_before = outcome();
  const auto view = make_view(kFront, "front", 2, 1280, 720);
  std::uint64_t accepted = 0;
  ASSERT_TRUE(eventually([&] {
    sink_.accept(view);
    ++accepted;
    return dropped() >= dropped_before + 100;
  }));
  ASSERT_TRUE(eventually([&] { return view.use_count() == 1; })) << "the view must come back";
  EXPECT_EQ(outcome() - outcome_before + dropped() - dropped_before, accepted);
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
  for (int i = 0; i < 100; ++i) sink_.accept(view);
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
  sink_.accept(view);
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
  DdsSink other(settings("cell3/orbwatch"), {"front"});
  ASSERT_TRUE(other.start());
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const ImageReader other_reader("rt/cell3/orbwatch/front/image_raw");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  const auto other_view = make_view(kFront, "front", 1, kWidth / 2, kHeight);
  const auto is_of = [](const ViewPtr& expected) {
    return [expected](const ImageMessage& message) {
      EXPECT_EQ(message.width, static_cast<std::uint32_t>(expected->colour.width));
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

TEST_F(DdsSinkTest, ViewsWithoutATopicAreCounted) {
  sink_.accept(make_view(2, "third", 1, kWidth, kHeight));
  EXPECT_EQ(sink_.statistics().unknown_views, 1u);
}

TEST(DdsSinkStartTest, DisabledSinkDoesNothing) {
  DdsSettings off = settings();
  off.enabled = false;
  off.domain = -1;  // would be refused
  DdsSink sink(off, {"front"});
  EXPECT_TRUE(sink.start());
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  sink.accept(view);
  EXPECT_EQ(view.use_count(), 1);
  EXPECT_EQ(sum(of_topic(sink, "rt/orbwatch/front/image_raw")), 0u);
}

TEST(DdsSinkStartTest, NamesAreChecked) {
  const auto refusal = [](const std::string& prefix, std::vector<std::string> names) {
    DdsSink sink(settings(prefix), std::move(names));
    const auto started = sink.start();
    return started ? std::string() : started.error().message;
  };
  EXPECT_THAT(refusal("orb watch", {"front"}), testing::HasSubstr("prefix \"orb watch\""));
  EXPECT_THAT(refusal("orbwatch", {"front", "no-dash"}), testing::HasSubstr("\"no-dash\""));
  EXPECT_THAT(refusal("orbwatch", {"front", "front"}), testing::HasSubstr("\"front\" is taken"));
  EXPECT_THAT(refusal("orbwatch", {"selected"}), testing::HasSubstr("\"selected\" is taken"));
}

}  // namespace
}  // namespace orbwatch::app
