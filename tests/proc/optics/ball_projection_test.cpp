#include "proc/optics/ball_projection.h"

#include <gtest/gtest.h>

#include <random>

#include "proc/optics/angle.h"
#include "proc/optics/rotation.h"
#include "tests/proc/reference_optics.h"

namespace orbwatch::optics {
namespace {

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

BallModel model_at(double distance) {
  return BallModel::exact(BallModel::alpha_from_distance(distance).value()).value();
}

TEST(BallProjection, ShowsTheRoomUnmirrored) {
  const auto ball = BallProjection::make(model_at(10), {{500, 400}, 100, 100, 0}, {}).value();
  const Vec2 right = ball.pixel({1, 0, 0}).value(), up = ball.pixel({0, 0, 1}).value();
  EXPECT_NEAR(right.u, 500 - 73, 0.5);  // -0.73 of the radius: left in the picture
  EXPECT_NEAR(right.v, 400, 1e-9);
  EXPECT_NEAR(up.u, 500, 1e-9);
  EXPECT_LT(up.v, 400);
  EXPECT_NEAR(ball.pixel({0, 1, 0})->u, 500, 1e-9);  // straight back at the camera
  EXPECT_FALSE(ball.pixel({0, -1, 0}));
}

TEST(BallProjection, EqualsTheReferenceWithEllipseAndRegistration) {
  std::mt19937 random(2);
  const tests::ReferenceBall reference{BallModel::Kind::Exact,
                                       BallModel::alpha_from_distance(8).value(),
                                       {{700, 500}, 420, 400, 25},
                                       rotation({60, -20, 5})};
  const auto ball = BallProjection::make(BallModel::exact(reference.alpha).value(),
                                         reference.outline, reference.registration)
                        .value();
  for (int i = 0; i < 3000; ++i) {
    const Vec3 v = random_direction(random);
    const auto mine = ball.pixel(v), truth = reference.pixel(v);
    ASSERT_EQ(mine.has_value(), truth.has_value());
    if (!mine) continue;
    EXPECT_NEAR(mine->u, truth->u, 1e-4);
    EXPECT_NEAR(mine->v, truth->v, 1e-4);
  }
}

TEST(BallProjection, DirectionIsTheInverseOfPixel) {
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    std::uniform_real_distribution<double> angle(-180, 180), radius(10, 2000), distance(1.1, 50);
    const auto ball = BallProjection::make(
        model_at(distance(random)),
        {{angle(random), angle(random)}, radius(random), radius(random), angle(random)},
        rotation({angle(random), angle(random), angle(random)}));
    const Vec3 v = random_direction(random);
    const auto pixel = ball->pixel(v);
    if (!pixel) continue;
    const auto again = ball->direction(*pixel);
    ASSERT_TRUE(again);
    // Near the limb a pixel's share of the sphere grows without bound, and rounding with it.
    EXPECT_LT(angle_between(*again, v), 1e-6);
  }
}

TEST(BallProjection, RefusesWhatIsNoEllipse) {
  const double nan = std::nan("");
  const BallModel model = BallModel::classical();
  EXPECT_FALSE(BallProjection::make(model, {{0, 0}, 0, 10, 0}, {}));
  EXPECT_FALSE(BallProjection::make(model, {{0, 0}, 10, -1, 0}, {}));
  EXPECT_FALSE(BallProjection::make(model, {{nan, 0}, 10, 10, 0}, {}));
  EXPECT_FALSE(BallProjection::make(model, {{0, 0}, nan, 10, 0}, {}));
  EXPECT_FALSE(BallProjection::make(model, {{0, 0}, 10, 10, nan}, {}));
  EXPECT_FALSE(BallProjection::make(model, {{0, 0}, 10, 10, 0}, {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

}  // namespace
}  // namespace orbwatch::optics
