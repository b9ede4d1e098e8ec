#include "proc/signals/hot_spot/hot_spot_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "tests/proc/signals/painted_region.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;

constexpr double kThreshold = 20000;
constexpr double kFrame = 0.02;  // s

/// A disc on the floor, as hot as everything hot; mm, machine frame.
struct Disc {
  double x = 0;
  double y = 0;
  double radius = 0;
};

constexpr Disc kPool{100, 200, 12};
constexpr Disc kSpark{260, 240, 8};

/// Frame sets of discs on the floor, followed by a track.
class Floor {
 public:
  explicit Floor(const HotSpotLimits& limits) : track_(limits) {}

  /// The place of the hot spot in the next frame set; nullopt: there is none.
  std::optional<Vec3> follow(const std::vector<Disc>& discs, double passed = kFrame) {
    painted_.clear();
    painted_.paint([&](const Vec3& d) {
      if (d.z >= 0) return 0.0;
      const Vec3 place = scene_.ball.centre + d * ((-300 - scene_.ball.centre.z) / d.z);
      for (const Disc& disc : discs) {
        if (std::hypot(place.x - disc.x, place.y - disc.y) < disc.radius) return 30000.0;
      }
      return 0.0;
    });
    hot_.find(painted_.plane(), painted_.seen(), mask_, geometry_);
    const std::size_t chosen = track_.follow(hot_, passed);
    if (chosen == LevelSet::kNone) return std::nullopt;
    const Blob& blob = hot_.blob(chosen);
    return scene_.ball.centre + blob.position * (1 / blob.solid_angle);
  }
  /// The same several times: of the last one.
  std::optional<Vec3> follow(int times, const std::vector<Disc>& discs) {
    std::optional<Vec3> last;
    for (int i = 0; i < times; ++i) last = follow(discs);
    return last;
  }

  HotSpotTrack& track() { return track_; }

 private:
  RegionScene scene_ = floor_scene();
  PaintedView painted_{{optics::ViewKind::Perspective, {40, -50, 0}, 70, {}, 320, 240}};
  RegionMask mask_ = RegionMask::make(painted_.view, {}).value();
  RegionGeometry geometry_{painted_.view, scene_, mask_};
  LevelSet hot_{mask_, kThreshold};
  HotSpotTrack track_;
};

void expect_at(const std::optional<Vec3>& place, const Disc& disc) {
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, disc.x, 1);
  EXPECT_NEAR(place->y, disc.y, 1);
  EXPECT_NEAR(place->z, -300, 0.1);
}

TEST(HotSpotTrack, WithoutLimitsTheLargestThatIsThereIsTaken) {
  Floor floor({});
  expect_at(floor.follow(5, {kPool, kSpark}), kPool);
  expect_at(floor.follow({kSpark}), kSpark);
  floor.follow(50, {});
  expect_at(floor.follow({kPool}), kPool);
}

TEST(HotSpotTrack, WhatIsSmallerThanTheLeastAreaIsNoHotSpot) {
  Floor floor({.min_area = 300});  // of the pool 452, of the spark 201
  expect_at(floor.follow({kPool, kSpark}), kPool);
  EXPECT_FALSE(floor.follow({kSpark}));
  EXPECT_FALSE(floor.follow({}));
}

TEST(HotSpotTrack, WhileItIsHiddenWhatIsOutOfReachIsNotTakenForIt) {
  Floor floor({.max_speed = 50});
  floor.follow(5, {kPool});
  EXPECT_FALSE(floor.follow({kSpark}));
  EXPECT_FALSE(floor.follow({{180, 200, 20}})) << "larger than the pool";
  expect_at(floor.follow({kPool, kSpark}), kPool);
}

TEST(HotSpotTrack, ItIsSeenAgainWhereItMayHaveGone) {
  const auto is_seen_after = [](double hidden) {
    Floor floor({.max_speed = 50});
    floor.follow(5, {kPool});
    floor.follow({}, hidden);
    return floor.follow(2, {{kPool.x + 60, kPool.y, kPool.radius}}).has_value();
  };
  // 60 mm, less its own radius of 12, take 0.96 s at 50 mm/s.
  EXPECT_FALSE(is_seen_after(0.90));
  EXPECT_TRUE(is_seen_after(0.94));
}

TEST(HotSpotTrack, AfterALossItIsBelievedWhenItIsSeenTwice) {
  Floor floor({.max_speed = 50});
  floor.follow(5, {kPool});
  floor.follow(4, {});
  expect_at(floor.follow({kPool}), kPool);  // it only flickered
  floor.follow(6, {});
  EXPECT_FALSE(floor.follow({{kPool.x + 15, kPool.y, 8}})) << "a spark in its reach";
  EXPECT_FALSE(floor.follow({{kPool.x - 9, kPool.y, 8}})) << "another";
  EXPECT_FALSE(floor.follow({{kPool.x, kPool.y - 10, 12}}));
  expect_at(floor.follow({{kPool.x, kPool.y - 10, 12}}), {kPool.x, kPool.y - 10});
}

TEST(HotSpotTrack, WhatStaysElsewhereForHalfASecondIsTheHotSpot) {
  Floor floor({.max_speed = 50});
  floor.follow(5, {kPool});
  EXPECT_FALSE(floor.follow(25, {kSpark})) << "0.48 s after it came";
  expect_at(floor.follow(2, {kSpark}), kSpark);
  EXPECT_NEAR(floor.track().confidence(), 0.6, 0.1) << "it is new";
}

TEST(HotSpotTrack, WhatFliesIsNeverTheHotSpotHoweverLong) {
  Floor floor({.max_speed = 50});
  floor.follow(5, {kPool});
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.5 * i;
    EXPECT_FALSE(floor.follow({{250 + 30 * std::cos(angle), 200 + 30 * std::sin(angle), 8}})) << i;
  }
}

TEST(HotSpotTrack, APoolOfWhichHalfIsHiddenStaysWithinItsReach) {
  Floor floor({.max_speed = 50});
  floor.follow(5, {kPool});
  expect_at(floor.follow({{kPool.x - 8, kPool.y, 3}}), {kPool.x - 8, kPool.y});
  expect_at(floor.follow({kPool}), kPool);
}

TEST(HotSpotTrack, ConfidenceGrowsWithWhatWasSeenBefore) {
  Floor floor({});
  floor.follow({kPool});
  EXPECT_EQ(floor.track().confidence(), 0.5);
  double before = 0.5;
  for (int i = 0; i < 25; ++i) {
    floor.follow({kPool});
    EXPECT_GT(floor.track().confidence(), before) << i;
    before = floor.track().confidence();
  }
  EXPECT_GT(before, 0.98);
  floor.follow(10, {});
  EXPECT_EQ(floor.track().confidence(), 0);
  floor.follow({kPool});
  EXPECT_NEAR(floor.track().confidence(), 0.58, 0.02) << "0.2 s without it";
}

TEST(HotSpotTrack, ConfidenceFallsWithAnotherOneLikeItAndAnUnusualSize) {
  Floor floor({});
  floor.follow(50, {kPool});
  const double sure = floor.track().confidence();
  floor.follow({kPool, kSpark});
  const double with_spark = floor.track().confidence();
  EXPECT_LT(with_spark, 0.98 * sure);
  floor.follow({kPool, {250, 200, 30}});
  EXPECT_LT(floor.track().confidence(), with_spark);
  floor.follow({{kPool.x, kPool.y, kPool.radius / 2}});
  EXPECT_NEAR(floor.track().confidence(), sure / 4, 0.05) << "a quarter of its area";
}

TEST(HotSpotTrack, StartsAnewAfterAReset) {
  Floor floor({.max_speed = 50});
  floor.follow(5, {kPool});
  floor.track().reset();
  expect_at(floor.follow({kSpark}), kSpark);
  EXPECT_EQ(floor.track().confidence(), 0.5);
}

}  // namespace
}  // namespace orbwatch::signals
