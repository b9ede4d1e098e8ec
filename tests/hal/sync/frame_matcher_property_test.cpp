// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "hal/sync/frame_matcher.h"

/// Random cameras, checked against the rules for every set, and against pairs found by looking at
/// all frames at once. Time is a number here: the test does not wait.
namespace orbwatch::hal {
namespace {

using std::chrono::microseconds;

constexpr TimePoint kLivesBegin{std::chrono::hours(1)};

int between(std::mt19937_64& random, int least, int most) {
  return std::uniform_int_distribution<int>(least, most)(random);
}

/// Event for a matcher from outside, in the order of `at`.
struct Event {
  TimePoint at;
  std::size_t camera = 0;
  std::optional<FrameMetadata> frame;  ///< none: a fault
};

/// Behaviour of one camera, all times in microseconds.
struct CameraPlan {
  int period = 0;
  int jitter = 0;    ///< largest jitter of an exposure start
  int latency = 0;   ///< least time from exposure start to arrival
  int delay = 0;     ///< largest additional delay of the arrival
  double loss = 0;   ///< probability; never two in a row, since the camera would then be late
  double fault = 0;  ///< probability before a frame: a restart that counts from 0 again
  bool triggered = false;
};

std::vector<Event> live(std::size_t camera, const CameraPlan& plan, int end,
                        std::mt19937_64& random) {
  std::vector<Event> events;
  std::bernoulli_distribution lost(plan.loss), fails(plan.fault);
  std::uint64_t sequence = 0;
  TimePoint arrived = kLivesBegin;
  std::uint64_t exposures = 0;
  bool is_lost = false;
  for (int at = plan.triggered ? 0 : between(random, 0, plan.period); at < end; at += plan.period) {
    ++exposures;
    const TimePoint exposed = kLivesBegin + microseconds(at + between(random, 0, plan.jitter));
    if (fails(random)) {
      events.push_back({std::max(arrived, exposed), camera, std::nullopt});
      sequence = 0;
      continue;
    }
    FrameMetadata metadata{.sequence = sequence++, .exposure_start = exposed};
    if (plan.triggered) metadata.trigger = exposures;
    is_lost = !is_lost && lost(random);
    if (is_lost) continue;
    arrived =
        std::max(arrived, exposed + microseconds(plan.latency + between(random, 0, plan.delay)));
    events.push_back({arrived, camera, metadata});
  }
  return events;
}

std::vector<Event> lives(const std::vector<CameraPlan>& plans, int end, std::mt19937_64& random) {
  std::vector<Event> all;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const auto events = live(i, plans[i], end, random);
    all.insert(all.end(), events.begin(), events.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Event& a, const Event& b) { return a.at < b.at; });
  return all;
}

/// Plays events to a matcher and keeps every set. `eager`: a set is taken the moment it is ready;
/// else only now and then.
class Play {
 public:
  Play(std::size_t cameras, const SyncSettings& settings, bool eager, std::uint64_t seed)
      : matcher(cameras, settings), eager_(eager), random_(seed) {}

  void run(const std::vector<Event>& events) {
    for (const Event& event : events) {
      take_until(event.at);
      now_ = event.at;
      if (event.frame) {
        matcher.put(event.camera, make(*event.frame), event.at, released_);
      } else {
        matcher.clear(event.camera, released_);
      }
      released_.clear();
      most_alive = std::max(most_alive, alive_);
      if (wants()) take(event.at);
    }
  }

  /// Ends the events; sets are taken until `end`.
  void finish(std::size_t cameras, TimePoint end = TimePoint::max()) {
    take_until(end);
    for (std::size_t i = 0; i < cameras; ++i) matcher.clear(i, released_);
    released_.clear();
  }

  FrameMatcher matcher;
  std::vector<FrameSet> sets;  ///< hold only copies of the frames' metadata
  int most_alive = 0;          ///< largest number of frames in the matcher at one time
  int alive() const { return alive_; }

 private:
  bool wants() { return eager_ || between(random_, 0, 4) == 0; }

  Frame make(const FrameMetadata& metadata) {
    ++alive_;
    auto* buffer = new FrameBuffer;
    buffer->metadata = metadata;
    return Frame(buffer, [this](const FrameBuffer* gone) {
      --alive_;
      delete gone;
    });
  }

  void take_until(TimePoint end) {
    while (eager_ && matcher.wake(now_) < end) {
      now_ = std::max(now_, matcher.wake(now_));
      if (!take(now_) && matcher.wake(now_) <= now_) break;
    }
  }

  bool take(TimePoint now) {
    bool any = false;
    while (auto set = matcher.take(now, released_)) {
      any = true;
      for (Frame& frame : set->frames) {
        if (!frame) continue;
        auto copy = std::make_shared<FrameBuffer>();
        copy->metadata = frame->metadata;
        frame = copy;
      }
      sets.push_back(std::move(*set));
      released_.clear();
    }
    released_.clear();
    return any;
  }

  bool eager_;
  std::mt19937_64 random_;
  TimePoint now_;
  ReleasedFrames released_;
  int alive_ = 0;
};

using Key = std::pair<std::size_t,
                      TimePoint>;  ///< unique, because all exposure starts of one camera differ

SyncSettings random_settings(std::mt19937_64& random) {
  SyncSettings settings;
  settings.window = microseconds(between(random, 0, 40'000));
  settings.max_wait = microseconds(between(random, 0, 60'000));
  for (SyncPolicy& policy : settings.policies) {
    policy = between(random, 0, 1) == 0 ? SyncPolicy::Hold : SyncPolicy::Nearest;
  }
  return settings;
}

std::vector<CameraPlan> random_cameras(std::mt19937_64& random) {
  std::vector<CameraPlan> plans(static_cast<std::size_t>(between(random, 1, 4)));
  const bool triggered = between(random, 0, 3) == 0;
  const int period = between(random, 5'000, 120'000);
  for (CameraPlan& plan : plans) {
    plan.period = triggered ? period : between(random, 5'000, 120'000);
    plan.jitter = between(random, 0, plan.period / 3);
    plan.latency = between(random, 0, 50'000);
    plan.delay = between(random, 0, 50'000);
    plan.loss = between(random, 0, 3) * 0.1;
    plan.fault = between(random, 0, 2) * 0.02;
    plan.triggered = triggered && between(random, 0, 5) != 0;
  }
  return plans;
}

/// Checks that every frame is put once, and is in one set at most, unless it is marked as held.
void expect_each_frame_once(const Play& play, const std::vector<Event>& events,
                            std::size_t cameras) {
  std::map<Key, int> fresh;
  std::array<std::uint64_t, kMaxCameras> put{}, used{};
  for (const Event& event : events) {
    if (!event.frame) continue;
    fresh[{event.camera, event.frame->exposure_start}] = 0;
    ++put[event.camera];
  }
  std::uint64_t id = 0;
  for (const FrameSet& set : play.sets) {
    ASSERT_EQ(set.id, ++id);
    for (std::size_t i = 0; i < cameras; ++i) {
      if (!set.frames[i]) continue;
      const auto found = fresh.find({i, set.frames[i]->metadata.exposure_start});
      ASSERT_NE(found, fresh.end()) << "a frame that nobody sent";
      if (set.held[i]) {
        EXPECT_EQ(found->second, 1) << "held, but was in no set";
      } else {
        EXPECT_EQ(++found->second, 1) << "camera " << i << " twice";
        ++used[i];
      }
    }
  }
  for (std::size_t i = 0; i < cameras; ++i) {
    const FrameCounts& counts = play.matcher.counts(i);
    EXPECT_EQ(counts.frames, put[i]);
    EXPECT_EQ(counts.used, used[i]);
    EXPECT_EQ(counts.frames, counts.used + counts.unmatched + counts.dropped()) << "camera " << i;
  }
}

/// Checks the data of a set against its frames.
void expect_sound(const FrameSet& set, const SyncSettings& settings, std::size_t cameras) {
  TimePoint first = set.stamp, last = set.stamp;
  bool paced = false;
  for (std::size_t i = 0; i < cameras; ++i) {
    if (!set.frames[i]) {
      EXPECT_FALSE(set.held[i]);
      continue;
    }
    const FrameMetadata& frame = set.frames[i]->metadata;
    paced = paced || (frame.exposure_start == set.stamp && frame.trigger == set.trigger);
    const bool same = set.trigger && frame.trigger
                          ? set.trigger == frame.trigger
                          : std::chrono::abs(frame.exposure_start - set.stamp) <= settings.window;
    EXPECT_TRUE(same || settings.policies[i] == SyncPolicy::Hold) << "camera " << i;
    EXPECT_TRUE(same || !set.matched);
    EXPECT_EQ(set.age(i), set.stamp - frame.exposure_start);
    if (!same) continue;
    first = std::min(first, frame.exposure_start);
    last = std::max(last, frame.exposure_start);
  }
  EXPECT_TRUE(paced);
  EXPECT_EQ(set.skew, last - first);
}

TEST(FrameMatcherProperties, NothingIsLostOrDoubledAndMemoryIsBounded) {
  std::size_t sets = 0, held = 0, matched = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto plans = random_cameras(random);
    const SyncSettings settings = random_settings(random);
    const auto events = lives(plans, 3'000'000, random);
    Play play(plans.size(), settings, between(random, 0, 1) == 0, seed);
    play.run(events);
    play.finish(plans.size());
    expect_each_frame_once(play, events, plans.size());
    std::set<std::uint64_t> triggers;
    std::optional<TimePoint> before;
    for (const FrameSet& set : play.sets) {
      expect_sound(set, settings, plans.size());
      if (!set.trigger && before) {
        EXPECT_GE(set.stamp, *before);
      }
      before = set.stamp;
      if (set.trigger) {
        EXPECT_TRUE(triggers.insert(*set.trigger).second) << "a trigger twice";
      }
      ++sets;
      matched += set.matched ? 1 : 0;
      held += std::count(set.held.begin(), set.held.end(), true) > 0 ? 1 : 0;
    }
    EXPECT_LE(play.most_alive, static_cast<int>(plans.size()) * 9);
    EXPECT_EQ(play.alive(), 0);
    if (testing::Test::HasFailure()) return;
  }
  // The random cameras must have made sets.
  EXPECT_GT(sets, 10'000U);
  EXPECT_GT(matched, 3'000U);
  EXPECT_GT(held, 3'000U);
}

TEST(FrameMatcherProperties, LostFramesAreCountedExactly) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::mt19937_64 random(seed);
    const auto events =
        lives({{.period = 10'000, .jitter = 1'000, .delay = 100, .loss = 0.3}}, 2'000'000, random);
    Play play(1, {}, true, seed);
    play.run(events);
    ASSERT_FALSE(events.empty());
    const std::uint64_t span = events.back().frame->sequence - events.front().frame->sequence + 1;
    EXPECT_EQ(play.matcher.counts(0).lost, span - events.size());
  }
}

/// Reference: the one frame of a camera within the window of a moment, or its newest before it,
/// among all frames that it ever sent.
struct Reference {
  const std::vector<Event>& events;
  const SyncSettings& settings;

  std::optional<TimePoint> partner(std::size_t camera, TimePoint moment, bool& matched) const {
    std::optional<TimePoint> best, before;
    for (const Event& event : events) {
      if (event.camera != camera) continue;
      const TimePoint exposed = event.frame->exposure_start;
      if (std::chrono::abs(exposed - moment) <= settings.window) best = exposed;
      if (exposed < moment && (!before || exposed > *before)) before = exposed;
    }
    matched = matched && best;
    if (best || settings.policies[camera] == SyncPolicy::Nearest) return best;
    return before;
  }
};

/// Cameras whose pairs are all unique and whose partners arrive before max_wait is over, because
/// the window is a fifth and max_wait half of the fastest period.
std::vector<CameraPlan> cameras_of_unique_pairs(int fastest, std::mt19937_64& random) {
  std::vector<CameraPlan> plans(static_cast<std::size_t>(between(random, 1, 4)));
  for (CameraPlan& plan : plans) {
    plan.period = between(random, 0, 1) == 0 ? fastest : between(random, fastest, 8 * fastest);
    plan.jitter = fastest / 50;
    plan.latency = between(random, 0, fastest / 4);
    plan.delay = fastest / 50;
    plan.loss = between(random, 0, 3) * 0.1;
  }
  return plans;
}

TEST(FrameMatcherProperties, PairsAreThoseOfAllFramesSeenAtOnce) {
  std::size_t matched_sets = 0, incomplete = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const int fastest = between(random, 8'000, 60'000);
    const auto plans = cameras_of_unique_pairs(fastest, random);
    SyncSettings settings = random_settings(random);
    settings.window = microseconds(fastest / 5);
    settings.max_wait = microseconds(fastest / 2);
    const auto events = lives(plans, 100 * fastest, random);
    Play play(plans.size(), settings, true, seed);
    play.run(events);
    play.finish(plans.size(), events.back().at + settings.max_wait + microseconds(1));

    const Reference reference{events, settings};
    std::size_t n = 0;
    for (const Event& event : events) {
      if (event.camera != 0) continue;
      ASSERT_LT(n, play.sets.size());
      const FrameSet& set = play.sets[n++];
      const TimePoint moment = event.frame->exposure_start;
      ASSERT_EQ(set.stamp, moment) << "every frame of the pacing camera makes a set, in order";
      bool matched = true;
      for (std::size_t i = 1; i < plans.size(); ++i) {
        const auto expected = reference.partner(i, moment, matched);
        ASSERT_EQ(set.frames[i] != nullptr, expected.has_value()) << "set " << n << " camera " << i;
        if (expected) {
          ASSERT_EQ(set.frames[i]->metadata.exposure_start, *expected)
              << "set " << n << " camera " << i;
        }
      }
      EXPECT_EQ(set.matched, matched);
      ++(matched ? matched_sets : incomplete);
    }
    EXPECT_EQ(n, play.sets.size());
    EXPECT_EQ(play.matcher.counts(0).superseded, 0U);
  }
  EXPECT_GT(matched_sets, 2'000U);
  EXPECT_GT(incomplete, 2'000U);
}

}  // namespace
}  // namespace orbwatch::hal
