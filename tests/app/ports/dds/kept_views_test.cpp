// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/sink_topics.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"

namespace orbwatch::app::dds {
namespace {

using tests::eventually;

/// A sink whose pictures wait, because the thread that writes them is blocked.
class KeptViewsTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }
  ~KeptViewsTest() override { go_on(); }

  void start(const DdsSettings& settings) {
    sink_.emplace(settings, tests::make_names(), nullptr, network_addresses,
                  std::make_shared<CommandRecord>(), threads_);
    ASSERT_TRUE(sink_->start());
    select(kFront);
  }
  void select(std::size_t view) {
    Status status;
    status.selected_view = view;
    sink_->accept(status);
  }
  void pause() {
    pausing_.request();
    is_paused_.wait(false);
  }
  void go_on() {
    may_go_on_ = true;
    may_go_on_.notify_all();
  }
  /// Passes a new view with a later stamp.
  void publish(std::size_t index) {
    auto view = tests::make_view(index, index == kFront ? "front" : "wide", 1, kWidth, kHeight,
                                 index == kFront);
    view->stamp = stamp_ += std::chrono::milliseconds(10);
    views_[index].push_back(view);
    tests::hand_over(*sink_, view);
  }
  /// Number of passed views that are still held.
  std::size_t kept(std::size_t index) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(views_[index], [](const auto& view) { return !view.expired(); }));
  }
  bool has_reader(std::size_t view, bool PictureNeeds::*need) {
    return sink_->needs(view, stamp_ + std::chrono::seconds(1)).*need;
  }
  void wait_for_readers(std::initializer_list<const char*> topics) {
    for (const char* topic : topics) {
      ASSERT_TRUE(eventually([&] {
        publish(kFront);
        return of_topic(*sink_, topic).written > 0;
      })) << topic;
    }
  }

  static constexpr const char* kOwn = "rt/orbwatch/front/image_raw";
  static constexpr const char* kOwnJpeg = "rt/orbwatch/front/image_raw/compressed";
  static constexpr const char* kSelected = "rt/orbwatch/selected/image_raw";
  static constexpr const char* kSelectedJpeg = "rt/orbwatch/selected/image_raw/compressed";

  tests::DdsNetwork network_;
  hal::TimePoint stamp_ = hal::Clock::now();
  std::array<std::vector<std::weak_ptr<const View>>, 2> views_;
  std::atomic<bool> is_paused_{false}, may_go_on_{false};
  std::shared_ptr<hal::SharedThreads> threads_ =
      std::make_shared<hal::SharedThreads>("background", hal::ThreadRole::Background, 1);
  hal::SharedThreads::Work pausing_{threads_, [this] {
                                      is_paused_ = true;
                                      is_paused_.notify_all();
                                      may_go_on_.wait(false);
                                    }};
  std::optional<DdsSink> sink_;
};

TEST_F(KeptViewsTest, TheNewestOfEachAndTheOneSelectedBefore) {
  start(settings());
  EXPECT_EQ(sink_->keeps().of_each, 1U);
  EXPECT_EQ(sink_->keeps().besides, 1U + 1 + 1) << "one is the thumbnail's, one is written";
  std::optional<ImageReader> own(std::in_place, kOwn);
  const ImageReader measured(radiometric_topic("orbwatch", "front")),
      wide("rt/orbwatch/wide/image_raw"), selected(kSelected);
  const CompressedReader own_jpeg(kOwnJpeg), selected_jpeg(kSelectedJpeg);
  wait_for_readers({kOwn, kOwnJpeg, kSelected, kSelectedJpeg});
  ASSERT_TRUE(eventually([&] { return has_reader(kWide, &PictureNeeds::rgb); }));
  pause();
  for (int n = 0; n < 3; ++n) publish(kFront);
  EXPECT_EQ(kept(kFront), 1U) << "by all topics together";
  select(kWide);
  publish(kFront);
  EXPECT_EQ(kept(kFront), 2U);
  publish(kWide);
  EXPECT_EQ(kept(kFront), 1U);
  EXPECT_EQ(kept(kWide), 1U);
  own.reset();
  ASSERT_TRUE(eventually([&] { return !has_reader(kFront, &PictureNeeds::rgb); }));
  publish(kFront);
  EXPECT_EQ(kept(kFront), 1U) << "nothing waits for a reader that went";
  go_on();
  EXPECT_TRUE(eventually([&] { return kept(kFront) + kept(kWide) == 0; }));
}

TEST_F(KeptViewsTest, NoOlderJpegWaitsForTheSelectedTopicWhileAnotherIsMadeForBoth) {
  start(settings());
  const CompressedReader selected_jpeg(kSelectedJpeg);
  wait_for_readers({kSelectedJpeg});
  pause();
  publish(kFront);
  const CompressedReader own_jpeg(kOwnJpeg);
  ASSERT_TRUE(eventually([&] {
    publish(kFront);
    return of_topic(*sink_, kOwnJpeg).replaced > 0;
  }));
  EXPECT_EQ(kept(kFront), 1U);
}

TEST_F(KeptViewsTest, AJpegThatWasDueWaitsBesideTheNewest) {
  DdsSettings chosen = settings();
  chosen.jpeg.rate = 1;
  start(chosen);
  EXPECT_EQ(sink_->keeps().of_each, 2U);
  EXPECT_EQ(sink_->keeps().besides, 2U + 1 + 1);
  const ImageReader own(kOwn);
  const CompressedReader own_jpeg(kOwnJpeg);
  wait_for_readers({kOwn, kOwnJpeg});
  pause();
  stamp_ += std::chrono::seconds(2);
  for (int n = 0; n < 3; ++n) publish(kFront);
  EXPECT_EQ(kept(kFront), 2U);
}

}  // namespace
}  // namespace orbwatch::app::dds
