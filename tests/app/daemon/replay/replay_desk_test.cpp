// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/replay_desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/recorder_settings.h"
#include "tests/app/daemon/replay/recorded_demo.h"

/// Replays of what the product's own pipeline measured of the demo.
namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::size_t kDemoSets = 60;
constexpr const char* kDemoEvent = "20261128T092200.125Z-alarm";

class ReplayOfDemo : public testing::Test {
 protected:
  static void SetUpTestSuite() { demo_ = new orbwatch::tests::RecordedDemo(kDemoSets); }
  static void TearDownTestSuite() {
    delete demo_;
    demo_ = nullptr;
  }

  void SetUp() override {
    const fs::path event = folder / "recordings/events" / kDemoEvent;
    fs::create_directories(event);
    demo_->write(event / recorder::kEventFile);
    start();
  }
  void start(const ReplayLimits& limits = {}) {
    RecorderSettings settings{.folder = folder / "recordings"};
    settings.events.emplace();
    const std::string& recipe = demo_->texts().files.at("demo-recipe.toml");
    desk.emplace(
        recorded_events(settings),
        RecipeTexts{{1, recipe},
                    {2, changed(recipe, "high_warning = 26", "high_warning = 12")},
                    {3, changed(recipe, "hot_spot_threshold = 1400", "hot_spot_threshold = 1500")},
                    {4, "name = 7"}},
        limits);
    desk->start();
  }
  static std::string changed(std::string text, const std::string& before,
                             const std::string& after) {
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, before.size(), after);
  }
  Result<std::uint64_t> begin(std::uint16_t recipe, const std::string& event = kDemoEvent) {
    return desk->begin({event, recipe, ""});
  }
  /// The newest replay once it has ended.
  ReplayStatus end() const {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (desk->status().state == ReplayState::Measuring) {
      if (std::chrono::steady_clock::now() > give_up) {
        ADD_FAILURE() << "the replay does not end";
        break;
      }
      std::this_thread::yield();
    }
    return desk->status();
  }
  ReplayResult replayed(std::uint16_t recipe) {
    const auto number = begin(recipe);
    EXPECT_TRUE(number) << number.error().message;
    const ReplayStatus status = end();
    EXPECT_EQ(status.state, ReplayState::Done) << status.error;
    const auto result = desk->result(status.number);
    EXPECT_TRUE(result) << result.error().message;
    return result ? **result : ReplayResult{};
  }
  static const ReplayedAlarm* alarm_in(const ReplayResult& result, const std::string& name) {
    const auto found = std::ranges::find(result.alarms, name, &ReplayedAlarm::name);
    return found == result.alarms.end() ? nullptr : &*found;
  }

  const orbwatch::tests::TemporaryFolder folder;
  std::optional<ReplayDesk> desk;
  static orbwatch::tests::RecordedDemo* demo_;
};
orbwatch::tests::RecordedDemo* ReplayOfDemo::demo_ = nullptr;

TEST_F(ReplayOfDemo, FindsNothingElseByTheRecordedRecipe) {
  for (const std::uint16_t recipe : {0, 1}) {
    const ReplayResult result = replayed(recipe);
    EXPECT_EQ(result.sets, demo_->pictures());
    EXPECT_GT(result.compared, 0U);
    EXPECT_LE(result.compared, result.sets) << "a slow computer records for more than 4 s";
    EXPECT_EQ(result.recipe, recipe);
    EXPECT_TRUE(result.signals.empty());
    ASSERT_FALSE(result.alarms.empty());
    for (const ReplayedAlarm& alarm : result.alarms) {
      EXPECT_TRUE(alarm.was_watched && alarm.is_watched && !alarm.differs) << alarm.name;
    }
  }
}

TEST_F(ReplayOfDemo, ShowsTheAlarmThatAnotherLimitRaises) {
  const ReplayResult result = replayed(2);
  const ReplayedAlarm* const alarm = alarm_in(result, "1, pool: hot_spot_width");
  ASSERT_NE(alarm, nullptr);
  EXPECT_TRUE(alarm->differs);
  EXPECT_TRUE(alarm->then.empty());
  ASSERT_FALSE(alarm->now.empty());
  EXPECT_EQ(alarm->now.front().level, signals::AlarmLevel::HighWarning);
  EXPECT_LE(alarm->now.front().first, alarm->now.front().last);
  EXPECT_TRUE(result.signals.empty()) << "the measurements are the same";
  const auto course = desk->course(result.number, "pool", "hot_spot_width");
  ASSERT_TRUE(course) << course.error().message;
  EXPECT_EQ(course->frame_sets.size(), result.sets);
  EXPECT_THAT(desk->course(result.number, "pool", "../x").error().message, HasSubstr("no signal"));
}

TEST_F(ReplayOfDemo, ShowsTheSignalsThatAnotherThresholdChanges) {
  const ReplayResult result = replayed(3);
  const auto found = std::ranges::find(result.signals, "hot_spot_width", &ReplayedSignal::figure);
  ASSERT_NE(found, result.signals.end());
  EXPECT_EQ(found->region, "pool");
  EXPECT_EQ(found->unit, "mm");
  EXPECT_GT(found->largest, 0);
  EXPECT_DOUBLE_EQ(found->largest, std::abs(found->recorded - found->computed));
  EXPECT_GE(found->largest_set, found->first_set);
  EXPECT_GT(found->sets, 10U);
}

TEST_F(ReplayOfDemo, RefusesWhatItCannotMeasure) {
  EXPECT_THAT(begin(1, "../x").error().message, HasSubstr("not the name of an event"));
  EXPECT_THAT(begin(1, std::string("x\0y", 3)).error().message,
              HasSubstr("not the name of an event"));
  EXPECT_THAT(begin(1, "20200101T000000.000Z-alarm").error().message, HasSubstr("no event"));
  EXPECT_THAT(begin(9).error().message, HasSubstr("recipe is 9; use one of: 0, 1, 2, 3, 4"));
  ASSERT_TRUE(begin(4));
  EXPECT_EQ(end().state, ReplayState::Failed);
  EXPECT_THAT(end().error, HasSubstr("name"));
  EXPECT_THAT(desk->result(desk->status().number).error().message, HasSubstr("no result"));
  const fs::path recording = folder / "recordings/events" / kDemoEvent / recorder::kEventFile;
  fs::remove(recording);
  demo_->write(recording, false);
  ASSERT_TRUE(begin(1));
  EXPECT_EQ(end().state, ReplayState::Failed);
  EXPECT_THAT(end().error, HasSubstr("no frame set with pictures"));
  fs::resize_file(recording, 100);
  ASSERT_TRUE(begin(1));
  EXPECT_EQ(end().state, ReplayState::Failed);
}

TEST_F(ReplayOfDemo, TakesNoMoreMemoryAndTimeThanThereIs) {
  start({.free_memory = [] { return std::uint64_t{1}; }});
  ASSERT_TRUE(begin(1));
  EXPECT_THAT(end().error, HasSubstr("MiB of memory"));
  start({.time = std::chrono::nanoseconds(0)});
  ASSERT_TRUE(begin(1));
  EXPECT_THAT(end().error, HasSubstr("takes too long"));
  EXPECT_GT(free_memory(), 0U);
}

TEST_F(ReplayOfDemo, RunsOneAtATimeUntilItIsCancelled) {
  std::promise<void> permission;
  const std::shared_future<void> permitted = permission.get_future().share();
  start({.free_memory = [permitted] {
    permitted.wait();
    return std::uint64_t{0};
  }});
  const auto first = begin(1);
  ASSERT_TRUE(first);
  EXPECT_THAT(begin(2).error().message, HasSubstr("another replay is running"));
  EXPECT_THAT(desk->cancel(*first + 1).error().message, HasSubstr("has ended"));
  ASSERT_TRUE(desk->cancel(*first));
  EXPECT_EQ(desk->status().state, ReplayState::Measuring) << "until its thread has noticed";
  permission.set_value();
  EXPECT_EQ(end().state, ReplayState::None);
  EXPECT_FALSE(desk->result(*first));
  EXPECT_FALSE(desk->cancel(*first));
  EXPECT_EQ(replayed(2).number, *first + 1);
  ASSERT_TRUE(begin(1));
  desk->stop();
  EXPECT_EQ(desk->status().state, ReplayState::None);
  EXPECT_THAT(begin(1).error().message, HasSubstr("is stopping"));
}

}  // namespace
}  // namespace orbwatch::app::daemon
