// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/measurement/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <random>
#include <thread>
#include <vector>

#include "tests/app/pipeline/measurement/measurement_bench.h"

namespace orbwatch::app::pipeline {
namespace {

using hal::Clock;
using hal::TimePoint;
using std::chrono::seconds;

TEST_F(MeasurementTest, BeginsWithTheFirstRecipe) {
  measure_by_two();
  Status before = idle();
  EXPECT_EQ(before.recipe, 1) << "without a frame, too";
  EXPECT_FALSE(is_measured(before));
  const Status measured = expose();
  EXPECT_EQ(measured.recipe, 1);
  EXPECT_EQ(measured.region_count, 1U);
  EXPECT_TRUE(is_measured(measured));
  EXPECT_EQ(published, 1U);
}

TEST_F(MeasurementTest, TheFirstSetExposedAfterTheCommandIsMeasuredByTheNewRecipe) {
  measure_by_two();
  for (const std::uint16_t recipe : {2, 1, 2, 2, 1}) {
    const TimePoint before = Clock::now();
    ASSERT_EQ(select(recipe), CommandResult::Done);
    const Status late = expose({}, before);
    EXPECT_TRUE(is_measured(late)) << "exposed before the command";
    const Status next = expose();
    EXPECT_EQ(next.recipe, recipe);
    EXPECT_TRUE(is_measured(next));
  }
}

TEST_F(MeasurementTest, SelectsWithoutFramesToo) {
  measure_by_two();
  expose();
  ASSERT_EQ(select(2), CommandResult::Done);
  const TimePoint before = Clock::now() - seconds(1);
  const Status switched = idle();
  EXPECT_EQ(switched.recipe, 2);
  EXPECT_FALSE(is_measured(switched)) << "nothing was measured by it yet";
  EXPECT_FALSE(is_measured(expose({}, before))) << "belongs to the recipe that is gone";
  EXPECT_TRUE(is_measured(expose()));
}

TEST_F(MeasurementTest, RefusesARecipeThatIsNotThere) {
  measure_by_two();
  for (const std::size_t number : {3, 65535, 0}) {
    EXPECT_EQ(select(number), CommandResult::ArgumentOutOfRange) << number;
  }
  EXPECT_EQ(expose().recipe, 1);
}

/// Reference: the recipe of each set by the moments of the commands.
class Requests {
 public:
  void add(std::uint16_t recipe, TimePoint before, TimePoint after) {
    requests_.push_back({recipe, before, after});
  }
  /// True if the set may belong to either of two recipes.
  bool is_doubtful(TimePoint stamp) const {
    return std::ranges::any_of(requests_, [stamp](const Request& request) {
      return stamp >= request.before && stamp <= request.after;
    });
  }
  std::uint16_t current() const { return requests_[current_].recipe; }
  /// Recipe of the next set; nullopt: none.
  std::optional<std::uint16_t> of(TimePoint stamp) {
    const std::size_t newest = requests_.size() - 1;
    if (stamp > requests_[newest].after) current_ = newest;
    const bool is_replaced = current_ < newest && stamp >= requests_[current_ + 1].before;
    const bool is_late = stamp < requests_[current_].before;
    return is_replaced || is_late ? std::nullopt : std::optional(current());
  }

 private:
  struct Request {
    std::uint16_t recipe;
    TimePoint before, after;
  };
  std::vector<Request> requests_{{1, TimePoint::min(), TimePoint::min()}};
  std::size_t current_ = 0;
};

TEST_F(MeasurementTest, NoStatusMixesTwoRecipesInAnyOrderOfEvents) {
  std::size_t measured = 0, skipped = 0;
  for (unsigned seed = 0; seed < 3; ++seed) {
    measure_by_two();
    Requests requests;
    std::vector<TimePoint> steps;
    std::mt19937 random(seed);
    for (int step = 0; step < 200; ++step) {
      const TimePoint now = Clock::now();
      steps.push_back(now - std::chrono::nanoseconds(1));
      // Half of the sets come late, by some of the previous steps.
      const std::size_t late = random() % 2 * (random() % std::min<std::size_t>(steps.size(), 6));
      const TimePoint stamp = late == 0 ? now : steps[steps.size() - late];
      const auto event = random() % 4;
      if (event == 0) {
        const auto recipe = static_cast<std::uint16_t>(1 + random() % 2);
        ASSERT_EQ(select(recipe), CommandResult::Done);
        requests.add(recipe, now, Clock::now());
      } else if (event == 1) {
        const Status status = idle();
        requests.of(Clock::now());
        ASSERT_EQ(status.recipe, requests.current());
        is_measured(status);
      } else if (!requests.is_doubtful(stamp)) {
        const Status status = expose({}, stamp);
        const auto recipe = requests.of(stamp);
        ASSERT_EQ(is_measured(status), recipe.has_value());
        ASSERT_EQ(status.recipe, requests.current());
        ++(recipe ? measured : skipped);
      }
    }
  }
  EXPECT_GT(measured, 100U);
  EXPECT_GT(skipped, 20U);
}

TEST_F(MeasurementTest, WhileCamerasAreSetNothingIsMeasured) {
  std::atomic<bool> go{false};
  measure_by({plan(1), plan(2)}, [&](std::size_t) -> Result<> {
    while (!go) std::this_thread::yield();
    return {};
  });
  ASSERT_TRUE(is_measured(expose()));
  ASSERT_EQ(select(2), CommandResult::Done);
  for (int n = 0; n < 3; ++n) {
    const Status between = expose();
    EXPECT_EQ(between.recipe, 1);
    EXPECT_FALSE(is_measured(between));
    EXPECT_EQ(published, sets) << "views go on";
  }
  go = true;
  EXPECT_EQ(expose_until_measured().recipe, 2);
}

TEST_F(MeasurementTest, AHeldFrameOfOtherSettingsIsNotMeasured) {
  measure_by({plan(1), plan(2)}, [](std::size_t) { return Result<>(); });
  expose();
  ASSERT_EQ(select(2), CommandResult::Done);
  const auto end = Clock::now() + seconds(30);
  Status status;
  do {  // the pacing camera continues, this one delivers no new frame
    status = process(Clock::now());
  } while (status.recipe != 2 && Clock::now() < end);
  EXPECT_EQ(status.recipe, 2);
  EXPECT_FALSE(is_measured(status));
  EXPECT_FALSE(is_measured(process(Clock::now())));
  EXPECT_TRUE(is_measured(expose()));
}

TEST_F(MeasurementTest, InATriggeredSetTheFrameOfAnotherTriggerIsNotMeasured) {
  measure_by_two();
  expose();
  std::const_pointer_cast<hal::FrameBuffer>(frame)->metadata.trigger = 1;
  EXPECT_TRUE(is_measured(process(Clock::now(), 1)));
  const Status next = process(Clock::now(), 2, true);
  EXPECT_FALSE(is_measured(next)) << "it shows the part before";
  EXPECT_EQ(next.result, 2U);
}

TEST_F(MeasurementTest, AHeldFrameIsOneMeasurement) {
  RecipePlan watched = plan(1);
  watched.alarms.push_back(hotter_than(100));
  watched.alarms[0].on_delay = std::chrono::nanoseconds(1);
  measure_by({watched});
  const Status measured = expose();
  for (int n = 0; n < 3; ++n) {
    const Status held = process(Clock::now(), {}, true);
    EXPECT_TRUE(is_measured(held));
    EXPECT_EQ(held.regions[0].signals.hot_spot_pixels, measured.regions[0].signals.hot_spot_pixels);
    idle();
  }
  EXPECT_TRUE(notices.empty()) << "nobody has measured for longer than the delay";
  expose();
  EXPECT_EQ(notices.size(), 1U);
}

TEST_F(MeasurementTest, SettlesForAsManySetsAsTheRecipeSays) {
  RecipePlan slow = plan(2);
  slow.settle_frames = 3;
  measure_by({plan(1), slow});
  EXPECT_TRUE(is_measured(expose()));
  ASSERT_EQ(select(2), CommandResult::Done);
  for (int n = 0; n < 3; ++n) {
    const Status settling = expose(1);
    EXPECT_EQ(settling.recipe, 2);
    EXPECT_FALSE(is_measured(settling));
    EXPECT_EQ(settling.result, static_cast<std::uint64_t>(n + 1)) << "who triggered is answered";
  }
  EXPECT_TRUE(is_measured(expose()));
  ASSERT_EQ(select(1), CommandResult::Done);
  EXPECT_TRUE(is_measured(expose())) << "the other recipe has none to wait for";
}

TEST_F(MeasurementTest, RefusedSettingsLeaveTheRecipeWhichSettlesAgain) {
  RecipePlan first = plan(1);
  first.settle_frames = 2;
  measure_by({first, plan(2)}, [](std::size_t recipe) -> Result<> {
    if (recipe == 0) return {};
    return fail("refused by the test");
  });
  ASSERT_TRUE(is_measured(expose()));
  ASSERT_EQ(select(2), CommandResult::Done);
  const auto end = Clock::now() + seconds(30);
  while (!status().recipe_refused && Clock::now() < end) std::this_thread::yield();
  for (int n = 0; n < 2; ++n) {
    const Status settling = expose();
    EXPECT_TRUE(settling.recipe_refused);
    EXPECT_EQ(settling.recipe, 1);
    EXPECT_FALSE(is_measured(settling)) << "cameras were set to the other recipe and back";
  }
  EXPECT_TRUE(is_measured(expose()));
}

TEST_F(MeasurementTest, EveryTriggeredSetIsAResultOnce) {
  measure_by_two();
  EXPECT_EQ(expose().result, 0U);
  EXPECT_EQ(expose(1).result, 1U);
  EXPECT_EQ(expose().result, 1U);
  EXPECT_EQ(idle().result, 1U);
  EXPECT_EQ(expose(2).result, 2U);
  EXPECT_EQ(expose(3).result, 3U);
}

TEST_F(MeasurementTest, ACommandedTriggerMakesTheNextSetAResult) {
  measure_by_two();
  const TimePoint before = Clock::now();
  ASSERT_EQ(measurement->trigger(), CommandResult::Done);
  EXPECT_EQ(measurement->trigger(), CommandResult::Busy);
  EXPECT_EQ(expose({}, before).result, 0U) << "exposed before the command";
  EXPECT_EQ(measurement->trigger(), CommandResult::Busy);
  EXPECT_EQ(expose().result, 1U);
  EXPECT_EQ(expose().result, 1U) << "once";
  EXPECT_EQ(measurement->trigger(), CommandResult::Done);
  EXPECT_EQ(expose().result, 2U);
}

TEST_F(MeasurementTest, ASetWithATriggerOfItsOwnAnswersACommandedOne) {
  measure_by_two();
  const TimePoint before = Clock::now();
  ASSERT_EQ(measurement->trigger(), CommandResult::Done);
  EXPECT_EQ(expose(7, before).result, 1U) << "exposed before the command";
  EXPECT_EQ(measurement->trigger(), CommandResult::Busy);
  EXPECT_EQ(expose(8).result, 2U);
  EXPECT_EQ(expose().result, 2U);
  EXPECT_EQ(measurement->trigger(), CommandResult::Done);
}

TEST_F(MeasurementTest, ACommandedTriggerWaitsForAFrameExposedAfterIt) {
  measure_by_two();
  expose();
  ASSERT_EQ(measurement->trigger(), CommandResult::Done);
  EXPECT_EQ(process(Clock::now(), {}, true).result, 0U) << "shows the part before";
  EXPECT_EQ(measurement->trigger(), CommandResult::Busy);
  const Status next = expose();
  EXPECT_EQ(next.result, 1U);
  EXPECT_TRUE(is_measured(next));
}

TEST_F(MeasurementTest, ACommandedTriggerWithoutASecondFrameIsAResultWithoutMeasurement) {
  measure_by_two();
  expose();
  ASSERT_EQ(measurement->trigger(), CommandResult::Done);
  const Status late = process(Clock::now() + seconds(2), {}, true);
  EXPECT_EQ(late.result, 1U);
  EXPECT_FALSE(is_measured(late));
  EXPECT_EQ(measurement->trigger(), CommandResult::Done) << "the one before was answered";
}

TEST_F(MeasurementTest, EveryTriggerThatIsTakenIsOneResultWhoeverCommands) {
  measure_by_two();
  std::atomic<std::uint64_t> taken{0};
  {
    std::vector<std::jthread> commanding;
    for (int n = 0; n < 2; ++n) {
      commanding.emplace_back([&](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          taken += measurement->trigger() == CommandResult::Done ? 1U : 0U;
          std::this_thread::yield();
        }
      });
    }
    const auto end = Clock::now() + seconds(30);
    while (expose().result < 100 && Clock::now() < end) {
    }
  }
  EXPECT_EQ(expose().result, taken);
  EXPECT_EQ(expose().result, taken);
}

TEST_F(MeasurementTest, StoppedItMeasuresNothingButAnswersTriggers) {
  measure_by_two();
  EXPECT_TRUE(is_measured(expose()));
  ASSERT_EQ(measurement->pause(), CommandResult::Done);
  EXPECT_FALSE(measurement->is_paused()) << "takes effect between two sets";
  EXPECT_TRUE(is_measured(status())) << "a status never mixes two states";
  const Status without_frames = idle();
  EXPECT_TRUE(measurement->is_paused());
  EXPECT_FALSE(is_measured(without_frames));
  const Status stopped = expose(1);
  EXPECT_FALSE(is_measured(stopped));
  EXPECT_EQ(stopped.result, 1U);
  EXPECT_FALSE(stopped.process_active);
  EXPECT_EQ(published, sets) << "views are published on";
  ASSERT_EQ(measurement->resume(), CommandResult::Done);
  EXPECT_TRUE(is_measured(expose()));
  EXPECT_FALSE(measurement->is_paused());
}

TEST_F(MeasurementTest, ACameraThatIsAwayIsNotMeasured) {
  measure_by_two();
  EXPECT_TRUE(is_measured(expose()));
  EXPECT_TRUE(is_measured(idle())) << "the newest values stay while nothing comes";
  EXPECT_FALSE(is_measured(idle(true)));
  frame.reset();
  EXPECT_FALSE(is_measured(process(Clock::now()))) << "others deliver";
}

TEST_F(MeasurementTest, TheProcessIsActiveAsTheRecipeSays) {
  const auto other = std::make_shared<hal::ProcessInput>(true);
  const auto laser = std::make_shared<hal::ProcessInput>(false);
  inputs = {other, laser};
  std::vector<RecipePlan> plans{plan(1), plan(2), plan(3), plan(4)};
  plans[1].process_active = ActiveSource::Input;
  plans[1].process_input = 1;
  plans[2].process_active = ActiveSource::Command;
  plans[3].process_active = ActiveSource::Detected;
  measure_by(std::move(plans));
  const auto is_active = [&](std::uint16_t bright = kBright) {
    return expose({}, Clock::now(), bright).process_active;
  };
  EXPECT_TRUE(is_active());

  ASSERT_EQ(select(2), CommandResult::Done);
  EXPECT_FALSE(is_active());
  laser->set(true);
  EXPECT_TRUE(is_active());
  other->set(false);
  EXPECT_TRUE(is_active());
  laser->set(false);
  EXPECT_FALSE(idle().process_active) << "without frames, too";

  ASSERT_EQ(select(3), CommandResult::Done);
  EXPECT_FALSE(is_active());
  ASSERT_EQ(measurement->set_process_active(true), CommandResult::Done);
  EXPECT_TRUE(is_active());
  ASSERT_EQ(measurement->set_process_active(false), CommandResult::Done);
  EXPECT_FALSE(is_active());

  ASSERT_EQ(select(4), CommandResult::Done);
  EXPECT_TRUE(is_active());
  EXPECT_FALSE(is_active(20000)) << "below the threshold of the hot spot";
  EXPECT_TRUE(is_active());
  EXPECT_TRUE(idle(true).process_active) << "as it was while something was seen";
}

}  // namespace
}  // namespace orbwatch::app::pipeline
