// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>

#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/offering_sink.h"
#include "tests/app/ports/dds/sink_topics.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"

/// Effects of the sink's settings, and refused settings.
namespace orbwatch::app::dds {
namespace {

using tests::eventually;
using tests::make_view;

class DdsSinkSettingsTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }
  tests::DdsNetwork network_;
};

TEST_F(DdsSinkSettingsTest, EncodingIsThatOfTheView) {
  std::vector<PublishedView> views(2);
  views[kFront].encoding = PixelFormat::Bgr;
  views[kWide].encoding = PixelFormat::Grey;
  DdsSink sink = tests::sink_offering(settings(), views);
  ASSERT_TRUE(sink.start());
  const ImageReader front("rt/orbwatch/front/image_raw"), wide("rt/orbwatch/wide/image_raw");
  const auto front_view = make_view(kFront, "front", 1, kWidth, kHeight);
  const auto wide_view = make_view(kWide, "wide", 1, kWidth, kHeight);
  const auto take = [&](const ImageReader& reader, const ViewPtr& view, const auto& look) {
    return eventually([&] {
      bool seen = false;
      tests::hand_over(sink, view);
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
      EXPECT_EQ(message.data._buffer[c], front_view->picture.samples<std::uint8_t>().data[2 - c]);
    }
  }));
  EXPECT_TRUE(take(wide, wide_view, [&](const ImageMessage& message) {
    EXPECT_STREQ(message.encoding, "mono8");
    EXPECT_EQ(message.step, static_cast<std::uint32_t>(kWidth));
    const std::uint8_t* rgb = wide_view->picture.samples<std::uint8_t>().data;
    EXPECT_NEAR(message.data._buffer[0], 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2], 1);
  }));
}

TEST_F(DdsSinkSettingsTest, NeedsAPictureAsItsReadersDo) {
  DdsSettings chosen = settings();
  chosen.jpeg.rate = 10;
  DdsSink sink(chosen, tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  auto moment = hal::Clock::now();
  const auto needs = [&](std::size_t view) {
    moment += std::chrono::seconds(1);
    return sink.needs(view, moment);
  };
  EXPECT_FALSE(needs(kFront).rgb || needs(kFront).jpeg) << "nobody reads";
  EXPECT_FALSE(needs(99).rgb) << "no such view";
  const CompressedReader compressed("rt/orbwatch/front/image_raw/compressed");
  ASSERT_TRUE(eventually([&] { return needs(kFront).jpeg; }));
  EXPECT_FALSE(needs(kFront).rgb);
  const ImageReader raw("rt/orbwatch/front/image_raw");
  ASSERT_TRUE(eventually([&] { return needs(kFront).rgb; }));
  EXPECT_FALSE(needs(kWide).rgb || needs(kWide).jpeg) << "of another view";
  // A JPEG that is not due is not needed; a topic that did not need the picture does not get it.
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  view->stamp = moment;
  tests::hand_over(sink, view);
  EXPECT_FALSE(sink.needs(kFront, moment + std::chrono::milliseconds(30)).jpeg);
  const auto unread = of_topic(sink, "rt/orbwatch/wide/image_raw").unread;
  const ImageReader late("rt/orbwatch/wide/image_raw");
  ASSERT_TRUE(eventually([&] {
    const auto other = make_view(kWide, "wide", 1, kWidth, kHeight);
    other->picture = {};
    sink.accept(other);  // needs() was called before the reader matched
    return of_topic(sink, "rt/orbwatch/wide/image_raw").unread > unread && needs(kWide).rgb;
  }));
}

TEST_F(DdsSinkSettingsTest, TheSelectedViewsJpegGoesToBothTopics) {
  DdsSink sink(settings(), tests::make_names(), nullptr);
  ASSERT_TRUE(sink.start());
  const std::string own = "rt/orbwatch/front/image_raw/compressed",
                    selected = "rt/orbwatch/selected/image_raw/compressed";
  const CompressedReader own_reader(own), selected_reader(selected);
  Status status;
  status.selected_view = kFront;
  sink.accept(status);
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  std::vector<std::uint8_t> from_own, from_selected;
  const auto copy_to = [](std::vector<std::uint8_t>& bytes) {
    return [&bytes](const CompressedImageMessage& message) {
      bytes.assign(message.data._buffer, message.data._buffer + message.data._length);
    };
  };
  ASSERT_TRUE(eventually([&] {
    tests::hand_over(sink, view);
    own_reader.take(copy_to(from_own));
    selected_reader.take(copy_to(from_selected));
    return !from_own.empty() && !from_selected.empty();
  }));
  EXPECT_EQ(from_own, from_selected);
  // From now on both have readers, and no picture is replaced: a released picture is written soon.
  ASSERT_TRUE(eventually([&] { return view.use_count() == 1; }));
  const auto written = [&](const std::string& topic) { return of_topic(sink, topic).written; };
  const auto own_before = written(own), selected_before = written(selected);
  for (int i = 0; i < 5; ++i) {
    view->stamp += std::chrono::seconds(1);
    tests::hand_over(sink, view);
    ASSERT_TRUE(eventually([&] { return view.use_count() == 1; }));
  }
  ASSERT_TRUE(eventually([&] { return written(selected) >= selected_before + 5; }));
  EXPECT_GE(written(own), own_before + 5);
  EXPECT_EQ(of_topic(sink, selected).replaced, 0U);
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
  // 30 pictures per second by their own stamps.
  std::uint64_t handed_over = 0;
  ASSERT_TRUE(eventually([&] {
    view->stamp = first + handed_over++ * std::chrono::microseconds(33333);
    tests::hand_over(sink, view);
    return of_topic(sink, topic).limited >= 60;
  }));
  const TopicStatistics result = of_topic(sink, topic);
  const std::uint64_t read = handed_over - result.unread;
  EXPECT_NEAR(static_cast<double>(result.limited), read * 2.0 / 3, 2);
  // The rate also holds after the clock is set back.
  for (int i = 0; i < 60; ++i) {
    view->stamp = first - std::chrono::hours(1) + i * std::chrono::microseconds(33333);
    tests::hand_over(sink, view);
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
      tests::hand_over(sink, view);
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
  off.domain = -1;  // would be refused if enabled
  DdsSink sink(off, {{}, {"front"}, {}}, nullptr);
  EXPECT_TRUE(sink.start());
  const auto view = make_view(kFront, "front", 1, kWidth, kHeight);
  tests::hand_over(sink, view);
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
  EXPECT_THAT(refusal("orbwatch", {"front", "front"}),
              testing::HasSubstr("\"front\" is already used"));
  EXPECT_THAT(refusal("orbwatch", {"selected"}),
              testing::HasSubstr("\"selected\" is already used"));
}

}  // namespace
}  // namespace orbwatch::app::dds