// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/frame_trigger.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "tests/hal/lines/edges.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

TriggerSettings line_settings() { return {.mode = TriggerMode::Line}; }

TriggerSettings software_settings() { return {.mode = TriggerMode::Software}; }

Result<> never() {
  ADD_FAILURE() << "asks for a frame";
  return {};
}

EdgeEvent rising(double when) { return {Edge::Rising, at(when)}; }

std::uint64_t sum(const TriggerCounts& counts) {
  return counts.frames + counts.missed + counts.waiting;
}

TEST(FrameTrigger, StampsTheFrameThatFollowsTheEdge) {
  FrameTrigger trigger(line_settings(), never);
  EXPECT_FALSE(trigger.claim(at(1))) << "no edge yet";
  trigger.on_edge(rising(10));
  EXPECT_FALSE(trigger.claim(at(9))) << "began before";
  const auto stamp = trigger.claim(at(10));
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp->id, 1U);
  EXPECT_EQ(stamp->edge, at(10));
  EXPECT_FALSE(trigger.claim(at(11))) << "one frame each";
  const TriggerCounts counts = trigger.counts();
  EXPECT_EQ(counts.frames, 1U);
  EXPECT_EQ(counts.untriggered, 3U);
}

TEST(FrameTrigger, AFrameThatArrivesLateKeepsItsTrigger) {
  FrameTrigger trigger(line_settings(), never);
  trigger.on_edge(rising(10));
  trigger.on_edge(rising(50));
  EXPECT_EQ(trigger.claim(at(10.1))->id, 1U);
  EXPECT_EQ(trigger.claim(at(50.1))->id, 2U);
  EXPECT_EQ(trigger.counts().missed, 0U);
}

TEST(FrameTrigger, AnEdgeDuringTheExposureIsMissed) {
  FrameTrigger trigger(line_settings(), never);
  trigger.on_edge(rising(10));
  trigger.on_edge(rising(20));
  trigger.on_edge(rising(40));
  EXPECT_EQ(trigger.claim(at(10.1))->id, 1U);
  EXPECT_EQ(trigger.claim(at(40.1))->id, 3U) << "the newest one before the exposure";
  EXPECT_EQ(trigger.counts().missed, 1U);
}

TEST(FrameTrigger, AStampAMomentTooEarlyKeepsItsTrigger) {
  FrameTrigger trigger(line_settings(), never);
  trigger.on_edge(rising(10));
  trigger.on_edge(rising(20));
  EXPECT_EQ(trigger.claim(at(9.6))->id, 1U) << "no other one is near";
  trigger.on_edge(rising(20.2));
  EXPECT_EQ(trigger.claim(at(20.05))->id, 2U) << "the next is near, but this one is nearer";
  EXPECT_EQ(trigger.claim(at(20.15))->id, 3U);
  EXPECT_EQ(trigger.counts().missed, 0U);
}

TEST(FrameTrigger, ActivationChoosesTheEdges) {
  const auto triggers = [](TriggerActivation activation) {
    FrameTrigger trigger({.mode = TriggerMode::Line, .activation = activation}, never);
    trigger.on_edge({Edge::Rising, at(1)});
    trigger.on_edge({Edge::Falling, at(2)});
    trigger.on_edge({Edge::Rising, at(3)});
    return trigger.counts().triggers;
  };
  EXPECT_EQ(triggers(TriggerActivation::RisingEdge), 2U);
  EXPECT_EQ(triggers(TriggerActivation::FallingEdge), 1U);
  EXPECT_EQ(triggers(TriggerActivation::AnyEdge), 3U);
}

TEST(FrameTrigger, DelaysTheExposure) {
  TriggerSettings settings = line_settings();
  settings.delay = milliseconds(5);
  FrameTrigger trigger(settings, never);
  trigger.on_edge(rising(10));
  EXPECT_FALSE(trigger.claim(at(14)));
  const auto stamp = trigger.claim(at(15));
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp->edge, at(10)) << "the stamp is the edge's own";
}

TEST(FrameTrigger, AStormLeavesEachFrameTheTriggerBeforeIt) {
  FrameTrigger trigger(line_settings(), never);
  std::uint64_t frames = 0;
  for (std::uint64_t edge = 1; edge <= 10000; ++edge) {
    trigger.on_edge(rising(static_cast<double>(edge)));
    if (edge % 100 != 0) continue;
    ++frames;
    const auto stamp = trigger.claim(at(static_cast<double>(edge) - 29.7));
    ASSERT_TRUE(stamp);
    EXPECT_EQ(stamp->id, edge - 30);
  }
  EXPECT_EQ(trigger.counts().triggers, 10000U);
  EXPECT_EQ(trigger.counts().frames, frames);
  EXPECT_EQ(sum(trigger.counts()), 10000U);
  EXPECT_LE(trigger.counts().waiting, FrameTrigger::kMaxWaiting);
}

TEST(FrameTrigger, BeyondTheLimitTriggersThatAreNotDueKeepTheirFrames) {
  constexpr double kPeriod = 50, kDelay = 2000;  // ms: 40 triggers would wait
  TriggerSettings settings = line_settings();
  settings.delay = milliseconds(2000);
  FrameTrigger trigger(settings, never);
  constexpr int kEdges = 200;
  int edge = 0, frames = 0;
  for (int frame = 0; frame < kEdges; ++frame) {
    const double exposure = kPeriod * frame + kDelay + 0.1;
    for (; edge < kEdges && kPeriod * edge < exposure; ++edge) {
      trigger.on_edge(rising(kPeriod * edge));
    }
    const auto stamp = trigger.claim(at(exposure));
    if (!stamp) continue;
    ++frames;
    EXPECT_EQ(stamp->edge, at(kPeriod * frame)) << "its own";
  }
  EXPECT_GE(frames, kEdges * 32 / 40);
  EXPECT_EQ(trigger.counts().missed, static_cast<std::uint64_t>(kEdges - frames));
  EXPECT_EQ(sum(trigger.counts()), static_cast<std::uint64_t>(kEdges));
}

TEST(FrameTrigger, ACameraFaultMissesWhatWaits) {
  FrameTrigger trigger(line_settings(), never);
  trigger.on_edge(rising(1));
  trigger.on_edge(rising(2));
  trigger.abandon();
  EXPECT_EQ(trigger.counts().missed, 2U);
  EXPECT_FALSE(trigger.claim(at(3)));
}

/// Claims a trigger `pause` ms after the last of 40 edges, one a second, during an outage.
std::pair<std::optional<TriggerStamp>, TriggerCounts> claimed_after_outage(double pause) {
  FrameTrigger trigger(line_settings(), never);
  trigger.on_edge(rising(0));
  trigger.abandon();
  constexpr int kEdges = 40;
  static_assert(kEdges > FrameTrigger::kMaxWaiting);
  for (int edge = 1; edge <= kEdges; ++edge) trigger.on_edge(rising(1000.0 * edge));
  const auto stamp = trigger.claim(at(1000.0 * kEdges + pause));
  return {stamp, trigger.counts()};
}

TEST(FrameTrigger, AFrameAfterAnOutageBelongsToTheTriggerThatBeganIt) {
  const auto [stamp, counts] = claimed_after_outage(0.1);
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp->id, 41U);
  EXPECT_EQ(stamp->edge, at(40000));
  EXPECT_EQ(counts.missed, 40U);
  EXPECT_EQ(counts.waiting, 0U);
}

TEST(FrameTrigger, AFrameLongAfterTheTriggersOfAnOutageBelongsToNone) {
  const auto [stamp, counts] = claimed_after_outage(60000);
  EXPECT_FALSE(stamp);
  EXPECT_EQ(counts.missed, 41U);
  EXPECT_EQ(counts.untriggered, 1U);
  EXPECT_EQ(counts.waiting, 0U);
}

TEST(FrameTrigger, ADamagedFrameMissesItsTriggerOnly) {
  FrameTrigger trigger(line_settings(), never);
  trigger.on_edge(rising(10));
  trigger.on_edge(rising(20));
  trigger.on_edge(rising(30));
  EXPECT_FALSE(trigger.miss(at(9))) << "of no trigger";
  EXPECT_EQ(trigger.counts().missed, 0U);
  EXPECT_TRUE(trigger.miss(at(10.1)));
  EXPECT_EQ(trigger.counts().missed, 1U);
  EXPECT_EQ(trigger.counts().frames, 0U);
  EXPECT_EQ(trigger.claim(at(20.1))->id, 2U);
  EXPECT_EQ(trigger.claim(at(30.1))->id, 3U);
  EXPECT_EQ(sum(trigger.counts()), 3U);
}

TEST(FrameTrigger, ACommandIsATriggerWhateverTheActivation) {
  for (const auto activation : {TriggerActivation::RisingEdge, TriggerActivation::FallingEdge,
                                TriggerActivation::AnyEdge}) {
    FrameTrigger trigger({.mode = TriggerMode::Line, .activation = activation}, never);
    trigger.fire(at(10));
    EXPECT_FALSE(trigger.claim(at(9))) << "began before";
    const auto stamp = trigger.claim(at(10));
    ASSERT_TRUE(stamp);
    EXPECT_EQ(stamp->id, 1U);
    EXPECT_EQ(stamp->edge, at(10));
  }
}

TEST(FrameTrigger, CommandsAndEdgesAreNumberedTogether) {
  FrameTrigger trigger(line_settings(), never);
  trigger.on_edge(rising(10));
  trigger.fire(at(20));
  trigger.on_edge(rising(30));
  for (const std::uint64_t id : {1U, 2U, 3U}) {
    EXPECT_EQ(trigger.claim(at(10.0 * static_cast<double>(id) + 1))->id, id);
  }
  EXPECT_EQ(trigger.counts().triggers, 3U);
}

TEST(FrameTrigger, CommandsFromManyThreadsAreAllCounted) {
  FrameTrigger trigger(line_settings(), never);
  constexpr std::uint64_t kEach = 500;
  {
    std::vector<std::jthread> commanding;
    for (int thread = 0; thread < 3; ++thread) {
      commanding.emplace_back([&] {
        for (std::uint64_t n = 0; n < kEach; ++n) trigger.fire(Clock::now());
      });
    }
    const std::jthread claiming([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) trigger.claim(Clock::now());
    });
    commanding.clear();
  }
  EXPECT_EQ(trigger.counts().triggers, 3 * kEach);
  EXPECT_EQ(sum(trigger.counts()), 3 * kEach) << "each is a frame, missed, or waits";
}

TEST(SoftwareTrigger, ACommandAsksTheCameraOnceTheDelayIsOver) {
  int asked = 0;
  TriggerSettings settings = software_settings();
  settings.delay = milliseconds(5);
  FrameTrigger trigger(settings, [&asked]() -> Result<> { return ++asked, Result<>(); });
  trigger.fire(at(10));
  EXPECT_EQ(asked, 0) << "fire does not wait for the camera: the line thread asks it";
  EXPECT_EQ(trigger.due(), at(15));
  trigger.run(at(15));
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(trigger.claim(at(15.1))->id, 1U);
}

TEST(SoftwareTrigger, AsksTheCameraWhenTheDelayIsOver) {
  int asked = 0;
  TriggerSettings settings = software_settings();
  settings.delay = milliseconds(5);
  FrameTrigger trigger(settings, [&asked]() -> Result<> { return ++asked, Result<>(); });
  EXPECT_EQ(trigger.due(), TimePoint::max());
  trigger.on_edge(rising(10));
  EXPECT_EQ(trigger.due(), at(15));
  trigger.run(at(14.9));
  EXPECT_EQ(asked, 0);
  EXPECT_FALSE(trigger.claim(at(16))) << "not asked for";
  trigger.run(at(15.2));
  EXPECT_EQ(asked, 1);
  EXPECT_FALSE(trigger.claim(at(15.1))) << "from before";
  EXPECT_EQ(trigger.claim(at(15.2))->id, 1U);
}

TEST(SoftwareTrigger, IsMissedWhileTheCameraOwesAFrame) {
  int asked = 0;
  FrameTrigger trigger(software_settings(), [&asked]() -> Result<> { return ++asked, Result<>(); });
  for (const double when : {10.0, 11.0, 12.0}) {
    trigger.on_edge(rising(when));
    trigger.run(at(when));
  }
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(trigger.counts().missed, 2U);
  EXPECT_EQ(trigger.claim(at(13))->id, 1U);
  trigger.on_edge(rising(14));
  trigger.run(at(14));
  EXPECT_EQ(trigger.claim(at(14))->id, 4U);
}

TEST(SoftwareTrigger, ACameraThatNeverAnswersIsAskedAgainAfterTheTimeout) {
  int asked = 0;
  FrameTrigger trigger(software_settings(), [&asked]() -> Result<> { return ++asked, Result<>(); });
  trigger.on_edge(rising(10));
  trigger.run(at(10));
  trigger.on_edge(rising(1010.1));
  trigger.run(at(1010.1));
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(trigger.counts().missed, 1U);
  EXPECT_EQ(trigger.claim(at(1011))->id, 2U);
}

TEST(SoftwareTrigger, BeyondTheLimitTheNewestIsMissed) {
  int asked = 0;
  TriggerSettings settings = software_settings();
  settings.delay = std::chrono::seconds(1);
  FrameTrigger trigger(settings, [&asked]() -> Result<> { return ++asked, Result<>(); });
  for (std::size_t n = 0; n <= FrameTrigger::kMaxWaiting; ++n) trigger.fire(at(0));
  EXPECT_EQ(trigger.counts().missed, 1U);
  trigger.run(at(1000));
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(trigger.claim(at(1001))->id, 1U);
}

TEST(SoftwareTrigger, ARefusalIsMissed) {
  FrameTrigger trigger(software_settings(), [] { return Result<>(fail("has none")); });
  trigger.on_edge(rising(10));
  trigger.run(at(10));
  EXPECT_EQ(trigger.counts().missed, 1U);
  EXPECT_EQ(trigger.counts().waiting, 0U);
}

/// The simulated camera is busy for `exposure` after each accepted edge, and delivers `transfer`
/// later, in time order with random edges: the edges that it accepted are the reference.
TEST(FrameTrigger, CountsExactlyOnRandomEdges) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<double> pause(1 / 8.0);
    constexpr double kExposure = 10, kTransfer = 7;
    FrameTrigger trigger(line_settings(), never);
    struct Exposure {
      double start;
      std::uint64_t id;
    };
    std::vector<Exposure> under_way;
    std::uint64_t frames = 0;
    const auto deliver_until = [&](double now) {
      while (!under_way.empty() && under_way.front().start + kExposure + kTransfer <= now) {
        const auto stamp = trigger.claim(at(under_way.front().start + 0.01));
        ASSERT_TRUE(stamp);
        EXPECT_EQ(stamp->id, under_way.front().id);
        ++frames;
        under_way.erase(under_way.begin());
      }
    };
    double now = 0, busy_until = 0;
    constexpr std::uint64_t kEdges = 300;
    for (std::uint64_t id = 1; id <= kEdges; ++id) {
      now += 0.1 + pause(random);
      deliver_until(now);
      trigger.on_edge(rising(now));
      if (now < busy_until) continue;
      under_way.push_back({now, id});
      busy_until = now + kExposure;
    }
    deliver_until(now + 100);
    trigger.abandon();
    const TriggerCounts counts = trigger.counts();
    EXPECT_EQ(counts.triggers, kEdges);
    EXPECT_EQ(counts.frames, frames);
    EXPECT_EQ(counts.missed, kEdges - frames) << "seed " << seed;
    EXPECT_EQ(counts.untriggered, 0U);
  }
}

TEST(FrameTrigger, CountsExactlyWhileThreadsInterleave) {
  for (const TriggerMode mode : {TriggerMode::Line, TriggerMode::Software}) {
    std::atomic<std::uint64_t> owed{0};
    FrameTrigger trigger({.mode = mode}, [&owed]() -> Result<> { return ++owed, Result<>(); });
    std::atomic<bool> done{false};
    std::uint64_t claimed = 0, last = 0;
    std::thread camera([&] {
      while (!done) {
        if (mode == TriggerMode::Software && owed.exchange(0) == 0) continue;
        const auto stamp = trigger.claim(Clock::now());
        if (!stamp) continue;
        EXPECT_GT(stamp->id, last) << "none twice, in order";
        last = stamp->id;
        ++claimed;
      }
    });
    for (int i = 0; i < 20000; ++i) {
      trigger.on_edge({Edge::Rising, Clock::now()});
      trigger.run(Clock::now());
      const TriggerCounts now = trigger.counts();
      ASSERT_EQ(now.triggers, sum(now));
    }
    done = true;
    camera.join();
    const TriggerCounts counts = trigger.counts();
    EXPECT_EQ(counts.triggers, 20000U);
    EXPECT_EQ(counts.frames, claimed);
    EXPECT_EQ(counts.triggers, sum(counts));
  }
}

}  // namespace
}  // namespace orbwatch::hal
