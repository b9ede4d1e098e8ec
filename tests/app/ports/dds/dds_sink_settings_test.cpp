#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>

#include "tests/app/ports/dds/sink_topics.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"

/// What the sink does as its settings say, and when it refuses to.
namespace orbwatch::app {
namespace {

using tests::eventually;
using tests::make_view;

class DdsSinkSettingsTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }
  tests::DdsNetwork network_;
};

TEST_F(DdsSinkSettingsTest, EncodingIsThatOfTheView) {
  DdsSettings chosen = settings();
  chosen.views = {{"front", {.encoding = PixelFormat::Bgr}},
                  {"wide", {.encoding = PixelFormat::Grey}}};
  DdsSink sink(chosen, tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  const ImageReader front("rt/orbwatch/front/image_raw"), wide("rt/orbwatch/wide/image_raw");
  const auto front_view = make_view(kFront, "front", 1, kWidth, kHeight);
  const auto wide_view = make_view(kWide, "wide", 1, kWidth, kHeight);
  const auto take = [&](const ImageReader& reader, const ViewPtr& view, const auto& look) {
    return eventually([&] {
      bool seen = false;
      sink.accept(view);
      reader.take([&](const ImageMessage& message) {
        look(message);
        seen = true;
      });
      return seen;
    });
  };
  EXPECT_TRUE(take(front, front_view, [&](const ImageMessage& message) {
    EXPECT_STREQ(message.encoding, "bgr8");
    EXPECT_EQ(message.step, 3u * kWidth);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(message.data._buffer[c], front_view->colour.data[2 - c]);
    }
  }));
  EXPECT_TRUE(take(wide, wide_view, [&](const ImageMessage& message) {
    EXPECT_STREQ(message.encoding, "mono8");
    EXPECT_EQ(message.step, static_cast<std::uint32_t>(kWidth));
    const std::uint8_t* rgb = wide_view->colour.data;
    EXPECT_NEAR(message.data._buffer[0], 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2], 1);
  }));
}

TEST_F(DdsSinkSettingsTest, JpegsKeepTheirRate) {
  DdsSettings chosen = settings();
  chosen.jpeg.rate = 10;
  DdsSink sink(chosen, tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  const std::string topic = "rt/orbwatch/front/image_raw/compressed";
  const CompressedReader reader(topic);
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  const auto first = view->stamp;
  // 30 pictures a second of their own clock.
  std::uint64_t handed_over = 0;
  ASSERT_TRUE(eventually([&] {
    view->stamp = first + handed_over++ * std::chrono::microseconds(33333);
    sink.accept(view);
    return of_topic(sink, topic).limited >= 60;
  }));
  const TopicStatistics result = of_topic(sink, topic);
  const std::uint64_t read = handed_over - result.unread;
  EXPECT_NEAR(static_cast<double>(result.limited), read * 2.0 / 3, 2);
  // Also when the clock is set back.
  for (int i = 0; i < 60; ++i) {
    view->stamp = first - std::chrono::hours(1) + i * std::chrono::microseconds(33333);
    sink.accept(view);
  }
  EXPECT_NEAR(static_cast<double>(of_topic(sink, topic).limited - result.limited), 40, 2);
}

TEST_F(DdsSinkSettingsTest, JoinsAgainWhenTheAddressesChange) {
  std::mutex mutex;
  std::optional<std::vector<NetworkAddress>> addresses{{{"eth0", "192.168.0.7"}}};
  const auto set = [&](std::optional<std::vector<NetworkAddress>> to) {
    const std::lock_guard lock(mutex);
    addresses = std::move(to);
  };
  std::atomic<int> looks = 0;
  DdsSink sink(settings(), tests::make_names(), nullptr, [&] {
    const std::lock_guard lock(mutex);
    ++looks;
    return addresses;
  });
  ASSERT_TRUE(sink.start());
  const auto joins = [&](std::uint64_t count) {
    return eventually([&] {
      sink.accept(Status{});
      return sink.statistics().joins == count;
    });
  };
  ASSERT_TRUE(joins(1));
  const ImageReader reader("rt/orbwatch/front/image_raw");
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight, true);
  const auto arrives = [&] {
    bool seen = false;
    return eventually([&] {
      sink.accept(view);
      reader.take([&](const auto&) { seen = true; });
      return seen;
    });
  };
  ASSERT_TRUE(arrives());
  set(std::nullopt);
  const auto before = looks.load();
  ASSERT_TRUE(eventually([&] {
    sink.accept(Status{});
    return looks >= before + 2;
  }));
  EXPECT_EQ(sink.statistics().joins, 1u) << "not known: no reason to leave";
  set({{{"eth0", "192.168.0.8"}}});
  ASSERT_TRUE(joins(2));
  reader.drain();
  EXPECT_TRUE(arrives()) << "the same reader gets pictures again";
}

TEST(DdsSinkStartTest, DisabledSinkDoesNothing) {
  DdsSettings off = settings();
  off.enabled = false;
  off.domain = -1;  // would be refused
  DdsSink sink(off, {{}, {"front"}, {}}, nullptr);
  EXPECT_TRUE(sink.start());
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  sink.accept(view);
  EXPECT_EQ(view.use_count(), 1);
  EXPECT_EQ(sum(of_topic(sink, "rt/orbwatch/front/image_raw")), 0u);
}

TEST(DdsSinkStartTest, NamesAreChecked) {
  const auto refusal = [](const std::string& prefix, std::vector<std::string> names) {
    DdsSink sink(settings(prefix), {{}, std::move(names), {}}, nullptr);
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