// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "proc/optics/view_projection.h"
#include "tests/proc/optics/random_camera.h"

// Evaluation of many lanes is bit-identical to single evaluation.
namespace orbwatch::optics {
namespace {

std::vector<BallProjection> balls(std::mt19937& random) {
  std::vector<BallProjection> all;
  for (const BallModel& model : {BallModel::make(BallModel::Kind::Exact, 348.5).value(),
                                 BallModel::make(BallModel::Kind::Exact, 200).value(),
                                 BallModel::make(BallModel::Kind::Exact, 360).value(),
                                 BallModel::make(BallModel::Kind::Paper, 346).value(),
                                 BallModel::make(BallModel::Kind::Classical).value()}) {
    all.push_back(
        BallProjection::make(model, {{700, 500}, 480, 470, 30}, rotation({20, -10, 30})).value());
  }
  for (const double distance : {1.02, 1.5, 12.0}) {
    CalibratedCamera camera = tests::random_camera(random, distance, 5);
    const auto add = [&](BallModel::Kind kind) {
      all.push_back(BallProjection::make(kind, camera, tests::kBall).value());
    };
    add(BallModel::Kind::Exact);
    add(BallModel::Kind::Paper);
    Intrinsics lens = camera.lens.intrinsics();
    lens.distortion = Distortion::Pinhole;
    lens.coefficients = {-0.1, 0.02, 0.001, -0.0005};
    camera.lens = Lens::make(lens).value();
    add(BallModel::Kind::Exact);
  }
  CalibratedCamera camera = tests::random_camera(random, 8, 5);
  camera.window = Window{tests::random_direction(random), 2, 1.52};
  all.push_back(BallProjection::make(BallModel::Kind::Exact, camera, tests::kBall).value());
  return all;
}

TEST(Lanes, ShowTheSamePixels) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(-0.2, 1.1);
  int shown = 0, hidden = 0;
  for (const BallProjection& ball : balls(random)) {
    for (int round = 0; round < 200; ++round) {
      Vec3Lanes directions;
      Lanes closeness;
      for (std::size_t k = 0; k < kLanes; ++k) {
        // Directions range from anywhere to nearly straight behind the ball, where the picture is
        // hardest to determine.
        const double aside = std::pow(10, -(round % 10));
        const Vec3 near = round % 2 ? ball.facing() : -ball.facing();
        directions.set(k, normalized(near + aside * tests::random_direction(random)));
        closeness[k] = round % 3 == 0 ? 0 : share(random);
      }
      directions.x[round % kLanes] = std::numeric_limits<double>::quiet_NaN();
      Vec2Lanes pixels;
      ball.pixels(directions, closeness, pixels);
      for (std::size_t k = 0; k < kLanes; ++k) {
        const auto one = ball.pixel(directions.at(k), closeness[k]);
        ++(one ? shown : hidden);
        ASSERT_EQ(std::isnan(pixels.u[k]), !one.has_value());
        if (!one) continue;
        EXPECT_EQ(pixels.u[k], one->u);
        EXPECT_EQ(pixels.v[k], one->v);
      }
    }
  }
  EXPECT_GT(shown, 20000);
  EXPECT_GT(hidden, 5000);
}

TEST(Lanes, LookInTheSameDirections) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> place(-300, 900);
  const auto ball = balls(random).front();
  for (const ViewKind kind :
       {ViewKind::Perspective, ViewKind::Equirectangular, ViewKind::Cylindrical,
        ViewKind::Stereographic, ViewKind::Fisheye, ViewKind::Ball}) {
    ViewSpec spec{kind, {}, {}, {}, 601, 333};
    if (kind != ViewKind::Ball) spec.orientation = {33, -20, 70};
    const auto view = ViewProjection::make(spec, ball).value();
    for (int round = 0; round < 20; ++round) {
      Vec2Lanes pixels;
      for (std::size_t k = 0; k < kLanes; ++k) {
        pixels.u[k] = place(random);
        pixels.v[k] = place(random);
      }
      Vec3Lanes directions;
      view.directions(pixels, directions);
      for (std::size_t k = 0; k < kLanes; ++k) {
        const auto one = view.direction(pixels.u[k], pixels.v[k]);
        ASSERT_EQ(std::isnan(directions.x[k]), !one.has_value());
        if (!one) continue;
        EXPECT_EQ(directions.x[k], one->x);
        EXPECT_EQ(directions.y[k], one->y);
        EXPECT_EQ(directions.z[k], one->z);
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::optics
