// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/hot_spot_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "tests/proc/signals/hot_spot/scalar_level_set.h"
#include "tests/proc/signals/painted_region.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;

constexpr double kFrame = 0.02;  // s

/// A disc on the floor with the uniform hot value; mm, machine frame.
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
    const ScalarLevelSet hot(painted_.plane(), painted_.seen(), kHotSpotThreshold, mask_,
                             geometry_);
    track_.begin(passed);
    for (std::size_t i = 0; i < hot.size(); ++i) {
      if (hot.is_whole(i)) track_.consider(hot.blob(i));
    }
    const auto blob = track_.choose();
    if (!blob) return std::nullopt;
    return scene_.ball.centre + blob->position * (1 / blob->solid_angle);
  }
  /// The same several times; returns the last result.
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
  Floor floor({.min_area = 300});  // mm2; the pool has 452, the spark 201
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

/// A disc of that area above (x, y) on a plane 400 mm below the ball's centre.
Blob blob_at(double x, double y, double area, const Span& first) {
  const Vec3 position{x, y, -400};
  Blob blob;
  blob.solid_angle = area * 1e-5;
  blob.moment = optics::normalized(position) * blob.solid_angle;
  blob.position = position * blob.solid_angle;
  blob.area = area;
  blob.first = first;
  return blob;
}

std::optional<Span> first_of_chosen(HotSpotTrack& track, std::vector<Blob> blobs) {
  track.begin(kFrame);
  for (const Blob& blob : blobs) track.consider(blob);
  const auto chosen = track.choose();
  return chosen ? std::optional(chosen->first) : std::nullopt;
}

TEST(HotSpotTrack, OfTwoAlikeTheUpperOneIsChosenInWhateverOrderTheyCome) {
  const Blob upper = blob_at(0, 100, 50, {3, 40, 50}), lower = blob_at(60, 100, 50, {4, 20, 30}),
             right = blob_at(90, 100, 50, {3, 60, 70});
  for (const auto& blobs : std::vector<std::vector<Blob>>{
           {upper, lower, right}, {lower, right, upper}, {right, upper, lower}}) {
    HotSpotTrack track{HotSpotLimits{}};
    const auto first = first_of_chosen(track, blobs);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->y, 3);
    EXPECT_EQ(first->begin, 40);
    EXPECT_DOUBLE_EQ(track.confidence(), 0.25) << "a half of it is new, and another is as large";
  }
}

TEST(HotSpotTrack, WhatIsInReachIsFoundBesideLargerOnes) {
  HotSpotTrack track({0, 100});
  const Blob pool = blob_at(0, 100, 50, {5, 10, 20});
  ASSERT_TRUE(first_of_chosen(track, {pool}));
  const Blob spark = blob_at(0, 3000, 90000, {1, 0, 99}),
             other = blob_at(0, 4000, 80000, {2, 0, 9});
  const auto first = first_of_chosen(track, {spark, other, pool});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->y, 5);
}

TEST(HotSpotTrack, IsSettledWhenNothingSmallerCanMatter) {
  HotSpotTrack any{HotSpotLimits{}};
  any.begin(kFrame);
  EXPECT_FALSE(any.is_settled(1e-9, 1));
  any.consider(blob_at(0, 100, 50, {5, 10, 20}));
  EXPECT_FALSE(any.is_settled(1e-9, 1)) << "its confidence depends on the largest other one";
  any.consider(blob_at(50, 100, 30, {7, 10, 20}));
  EXPECT_TRUE(any.is_settled(29e-5, 29));
  EXPECT_FALSE(any.is_settled(31e-5, 31));
  HotSpotTrack large({20});
  large.begin(kFrame);
  EXPECT_TRUE(large.is_settled(1, 19));
  EXPECT_FALSE(large.is_settled(1, 21));
}

}  // namespace
}  // namespace orbwatch::signals
