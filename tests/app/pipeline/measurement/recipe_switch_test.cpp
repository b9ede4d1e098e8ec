// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/measurement/recipe_switch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace orbwatch::app::pipeline {
namespace {

using hal::Clock;
using hal::TimePoint;
using std::chrono::hours;
using std::chrono::nanoseconds;
using std::chrono::seconds;

/// Cameras that apply settings when the test permits it.
class HandCameras {
 public:
  RecipeSwitch::Apply apply() {
    return [this](std::size_t recipe) { return set(recipe); };
  }

  /// Waits for the next request of settings, which stays pending; returns its recipe.
  std::size_t wait_for_request() {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, seconds(30), [this] { return asked_.has_value(); }));
    return asked_.value_or(1000);
  }
  void accept() { answer(true); }
  void refuse() { answer(false); }

  /// All requests, in order.
  std::vector<std::size_t> log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }

 private:
  Result<> set(std::size_t recipe) {
    std::unique_lock lock(mutex_);
    log_.push_back(recipe);
    asked_ = recipe;
    changed_.notify_all();
    EXPECT_TRUE(changed_.wait_for(lock, seconds(30), [this] { return answer_.has_value(); }));
    const bool accepted = answer_.value_or(false);
    asked_.reset();
    answer_.reset();
    changed_.notify_all();
    if (accepted) return {};
    return fail("camera a: recipe " + std::to_string(recipe) + " is refused");
  }
  void answer(bool accepted) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, seconds(30), [this] { return asked_.has_value(); }));
    answer_ = accepted;
    changed_.notify_all();
    EXPECT_TRUE(changed_.wait_for(lock, seconds(30), [this] { return !answer_.has_value(); }));
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::size_t> log_;
  std::optional<std::size_t> asked_;
  std::optional<bool> answer_;
};

/// Paces the frames: a busy loop would keep the mutex for itself.
void next_frame() { std::this_thread::sleep_for(std::chrono::microseconds(50)); }

std::optional<std::size_t> recipe_of(RecipeSwitch& recipes, TimePoint stamp = Clock::now()) {
  const auto selection = recipes.selection_at(stamp);
  return selection ? std::optional(selection->recipe) : std::nullopt;
}

/// Present selection, as soon as there is one.
RecipeSwitch::Selection settled(RecipeSwitch& recipes) {
  const auto end = Clock::now() + seconds(30);
  std::optional<RecipeSwitch::Selection> selection;
  while (!(selection = recipes.selection_at(Clock::now())) && Clock::now() < end) next_frame();
  EXPECT_TRUE(selection);
  return selection.value_or(RecipeSwitch::Selection{1000, {}, 0});
}

TEST(RecipeSwitch, BeginsWithTheFirstRecipeAndSetsNothing) {
  HandCameras cameras;
  RecipeSwitch recipes(2, cameras.apply());
  recipes.start();
  const RecipeSwitch::Selection first{2, TimePoint::min(), 0};
  EXPECT_EQ(recipes.selection_at(Clock::now()), first);
  EXPECT_EQ(recipes.selection_at(TimePoint{}), first) << "whenever it was exposed";
  EXPECT_EQ(recipes.selection_at(Clock::now() + hours(1)), first);
  EXPECT_FALSE(recipes.has_failed());
  EXPECT_TRUE(cameras.log().empty());
}

TEST(RecipeSwitch, ARequestBeforeTheStartSetsTheCamerasAfterIt) {
  HandCameras cameras;
  RecipeSwitch recipes(0, cameras.apply());
  recipes.request(1);
  recipes.request(2);
  EXPECT_EQ(recipe_of(recipes), std::nullopt) << "nothing is measured meanwhile";
  EXPECT_TRUE(cameras.log().empty());
  recipes.start();
  cameras.accept();
  EXPECT_EQ(settled(recipes).recipe, 2U);
  EXPECT_EQ(cameras.log(), (std::vector<std::size_t>{2}));
}

TEST(RecipeSwitch, FramesBelongToTheNewRecipeOnceCamerasWereSet) {
  HandCameras cameras;
  RecipeSwitch recipes(0, cameras.apply());
  recipes.start();
  const TimePoint before = Clock::now();
  recipes.request(1);
  const TimePoint requested = Clock::now();
  EXPECT_EQ(recipe_of(recipes, before), 0U) << "exposed before the request, come late";
  EXPECT_EQ(recipe_of(recipes, requested), std::nullopt) << "the cameras may not have begun";
  EXPECT_EQ(cameras.wait_for_request(), 1U);
  const TimePoint between = Clock::now();
  EXPECT_EQ(recipe_of(recipes, between), std::nullopt);
  EXPECT_EQ(recipe_of(recipes, before), 0U);
  cameras.accept();
  const auto selection = settled(recipes);
  EXPECT_EQ(selection.recipe, 1U);
  EXPECT_EQ(selection.changes, 1U);
  EXPECT_GT(selection.set_since, between);
  EXPECT_LE(selection.set_since, Clock::now());
  EXPECT_EQ(recipes.selection_at(selection.set_since), selection) << "the moment itself counts";
  for (const TimePoint late : {before, requested, between, selection.set_since - nanoseconds(1)}) {
    EXPECT_EQ(recipe_of(recipes, late), std::nullopt) << "arrived after a newer selection";
  }
}

TEST(RecipeSwitch, RefusedSettingsGoBackAndThatIsSaid) {
  HandCameras cameras;
  RecipeSwitch recipes(0, cameras.apply());
  recipes.start();
  recipes.request(1);
  cameras.accept();
  ASSERT_EQ(settled(recipes).recipe, 1U);
  recipes.request(2);
  cameras.refuse();
  EXPECT_EQ(cameras.wait_for_request(), 1U) << "the one before";
  EXPECT_EQ(recipe_of(recipes), std::nullopt) << "some cameras may be set to the other";
  EXPECT_FALSE(recipes.has_failed()) << "not known as long as it is under way";
  EXPECT_EQ(recipes.refusal(), std::nullopt);
  cameras.accept();
  const auto selection = settled(recipes);
  EXPECT_EQ(selection.recipe, 1U);
  EXPECT_EQ(selection.changes, 2U) << "cameras take on their settings again";
  EXPECT_TRUE(recipes.has_failed());
  EXPECT_EQ(recipes.refusal(), (RecipeSwitch::Refusal{.wanted = 2, .kept = 1}));
  recipes.request(0);
  EXPECT_FALSE(recipes.has_failed()) << "that was another request";
  EXPECT_EQ(recipes.refusal(), std::nullopt);
  cameras.accept();
  EXPECT_EQ(settled(recipes).recipe, 0U);
  EXPECT_FALSE(recipes.has_failed());
  EXPECT_EQ(cameras.log(), (std::vector<std::size_t>{1, 2, 1, 0}));
}

TEST(RecipeSwitch, GoesOnWithTheRecipeBeforeWhenTheWayBackIsRefusedToo) {
  HandCameras cameras;
  RecipeSwitch recipes(0, cameras.apply());
  recipes.start();
  recipes.request(1);
  cameras.refuse();
  cameras.refuse();
  EXPECT_EQ(settled(recipes).recipe, 0U);
  EXPECT_TRUE(recipes.has_failed());
  recipes.request(1);
  cameras.accept();
  EXPECT_EQ(settled(recipes).recipe, 1U);
}

TEST(RecipeSwitch, TheNewestRequestWins) {
  HandCameras cameras;
  RecipeSwitch recipes(0, cameras.apply());
  recipes.start();
  recipes.request(1);
  cameras.wait_for_request();
  recipes.request(2);
  recipes.request(3);
  recipes.request(4);
  const TimePoint requested = Clock::now();
  cameras.accept();
  EXPECT_EQ(cameras.wait_for_request(), 4U) << "2 and 3 were replaced";
  EXPECT_EQ(recipe_of(recipes, requested), std::nullopt) << "1 is not wanted any more";
  EXPECT_EQ(recipe_of(recipes), std::nullopt);
  cameras.accept();
  EXPECT_EQ(settled(recipes).recipe, 4U);
  EXPECT_EQ(cameras.log(), (std::vector<std::size_t>{1, 4}));
}

TEST(RecipeSwitch, ARefusalThatANewerRequestOvertookIsNotReported) {
  HandCameras cameras;
  RecipeSwitch recipes(0, cameras.apply());
  recipes.start();
  recipes.request(1);
  cameras.wait_for_request();
  recipes.request(2);
  cameras.refuse();
  cameras.accept();  // returns to 0
  EXPECT_EQ(cameras.wait_for_request(), 2U);
  EXPECT_FALSE(recipes.has_failed());
  cameras.refuse();
  EXPECT_EQ(cameras.wait_for_request(), 0U) << "1 was never set";
  cameras.accept();
  EXPECT_EQ(settled(recipes).recipe, 0U);
  EXPECT_TRUE(recipes.has_failed());
}

TEST(RecipeSwitch, NothingExposedAfterARequestBelongsToARecipeBeforeIt) {
  RecipeSwitch recipes(0, [](std::size_t) { return Result<>(); });
  recipes.start();
  std::mt19937 random(1);
  for (std::size_t n = 1; n <= 500; ++n) {
    recipes.request(n);
    // Often none of these is returned before the next request, which may be pending already.
    for (unsigned frames = random() % 4; frames > 0; --frames) {
      ASSERT_EQ(recipe_of(recipes).value_or(n), n);
    }
    for (unsigned pause = random() % 3; pause > 0; --pause) next_frame();
    if (n % 50 == 0) {
      EXPECT_EQ(settled(recipes).recipe, n);
    }
  }
}

TEST(RecipeSwitch, StopsAfterTheSettingsUnderWay) {
  for (std::size_t round = 0; round < 20; ++round) {
    std::atomic<std::size_t> begun{0}, ended{0};
    RecipeSwitch recipes(0, [&](std::size_t) -> Result<> {
      ++begun;
      next_frame();
      ++ended;
      return {};
    });
    recipes.start();
    for (std::size_t n = 0; n < round; ++n) recipes.request(n);
    recipes.stop();
    EXPECT_EQ(begun, ended);
    const std::size_t before = begun;
    recipes.request(1);
    EXPECT_NE(recipe_of(recipes), 1U) << "nobody sets it any more";
    recipes.stop();
    EXPECT_EQ(begun, before);
  }
}

TEST(RecipeSwitch, WithoutCamerasToSetARecipeCountsFromItsRequestOn) {
  RecipeSwitch recipes(0, nullptr);
  recipes.start();
  const TimePoint before = Clock::now();
  recipes.request(1);
  const TimePoint after = Clock::now();
  EXPECT_EQ(recipe_of(recipes, before), 0U);
  EXPECT_EQ(recipes.selection_at(after), (RecipeSwitch::Selection{1, TimePoint::min(), 0}));
  EXPECT_EQ(recipe_of(recipes, before), std::nullopt) << "come too late";
  recipes.request(2);
  const TimePoint second = Clock::now();
  recipes.request(3);
  EXPECT_EQ(recipe_of(recipes, second), std::nullopt) << "2 was replaced before a frame came";
  EXPECT_EQ(recipe_of(recipes), 3U);
  EXPECT_FALSE(recipes.has_failed());
  recipes.stop();
}

/// Settings of the cameras and returned selections, for a later comparison.
struct Setting {
  std::size_t recipe;
  bool done;
  TimePoint begin, end;
};
struct Returned {
  TimePoint stamp;
  RecipeSwitch::Selection selection;
};
struct Request {
  std::size_t recipe;
  TimePoint begin, end;  ///< the setting was made in between
};

/// Setting of the cameras at a moment; nullopt while they were being set.
std::optional<std::size_t> setting_at(const std::vector<Setting>& settings, TimePoint moment) {
  std::size_t recipe = 0;
  for (const Setting& setting : settings) {
    if (moment < setting.begin) break;
    if (moment < setting.end) return std::nullopt;
    if (setting.done) recipe = setting.recipe;
  }
  return recipe;
}

constexpr std::size_t kRefused = 3;  ///< the recipe whose settings cameras refuse

/// True if a recipe may be that of the newest request made until a moment, or may be in force again
/// after a refusal.
bool is_wanted(const std::vector<Request>& requests, std::size_t recipe, TimePoint moment) {
  for (auto request = requests.rbegin(); request != requests.rend(); ++request) {
    if (request->begin > moment) continue;
    if (request->recipe == recipe || request->recipe == kRefused) return true;
    if (request->end <= moment) return false;
  }
  return recipe == 0;  // the first one
}

class RandomOrders : public testing::TestWithParam<unsigned> {};

TEST_P(RandomOrders, EveryFrameBelongsToWhatCamerasWereSetToThen) {
  std::vector<Setting> settings;
  std::mt19937 pace(GetParam());
  RecipeSwitch recipes(0, [&](std::size_t recipe) -> Result<> {
    const TimePoint begin = Clock::now();
    for (unsigned n = pace() % 3; n > 0; --n) next_frame();
    const bool done = recipe != kRefused;
    settings.push_back({recipe, done, begin, Clock::now()});
    return done ? Result<>() : fail("refused");
  });
  recipes.start();
  std::vector<Request> requests;
  std::vector<Returned> returned;
  {
    const std::jthread frames([&](const std::stop_token& stop) {
      std::mt19937 random(GetParam() + 1);
      while (!stop.stop_requested()) {
        const TimePoint stamp =
            Clock::now() - nanoseconds(random() % 4 == 0 ? random() % 100000 : 0);
        if (const auto selection = recipes.selection_at(stamp))
          returned.push_back({stamp, *selection});
        next_frame();
      }
    });
    std::mt19937 random(GetParam() + 2);
    for (int n = 0; n < 400; ++n) {
      const std::size_t recipe = random() % 4;
      const TimePoint begin = Clock::now();
      recipes.request(recipe);
      requests.push_back({recipe, begin, Clock::now()});
      for (unsigned pause = random() % 8; pause > 0; --pause) next_frame();
    }
    const TimePoint begin = Clock::now();
    recipes.request(2);
    requests.push_back({2, begin, Clock::now()});
    EXPECT_EQ(settled(recipes).recipe, 2U) << "once it is quiet, the newest request holds";
  }
  recipes.stop();
  EXPECT_FALSE(returned.empty());
  std::uint64_t changes = 0;
  for (const auto& [stamp, selection] : returned) {
    ASSERT_EQ(setting_at(settings, stamp), selection.recipe) << "of what the cameras were set to";
    ASSERT_GE(stamp, selection.set_since);
    ASSERT_EQ(setting_at(settings, selection.set_since), selection.recipe);
    ASSERT_TRUE(is_wanted(requests, selection.recipe, stamp)) << "exposed after another request";
    ASSERT_GE(selection.changes, changes) << "never goes back";
    changes = selection.changes;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomOrders, testing::Range(0U, 12U, 3U));

}  // namespace
}  // namespace orbwatch::app::pipeline
