// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/ball_projection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <random>

#include "proc/optics/rotation.h"
#include "proc/optics/vec.h"
#include "tests/proc/optics/random_camera.h"
#include "tests/proc/reference_optics.h"
#include "tests/support/pixel_of_point.h"

namespace orbwatch::optics {
namespace {

using Kind = BallModel::Kind;
using tests::camera_ray;
using tests::deviation;
using tests::kBall;
using tests::kInfinity;
using tests::point_on;
using tests::position_in_radii;
using tests::random_camera;
using tests::random_direction;
using tests::RealVec3;
using tests::rounded;
using tests::scene_around_ball;

BallModel model_at(double distance) {
  return BallModel::at_distance(BallModel::Kind::Exact, distance);
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
  const tests::ReferenceBall reference{Kind::Exact,
                                       360 - 2 * degrees(std::asin(1.0 / 8)),
                                       {{700, 500}, 420, 400, 25},
                                       rotation({60, -20, 5})};
  const auto ball =
      BallProjection::make(model_at(8), reference.outline, reference.registration).value();
  for (int i = 0; i < 3000; ++i) {
    const Vec3 v = random_direction(random);
    const auto mine = ball.pixel(v), truth = reference.pixel(v);
    ASSERT_EQ(mine.has_value(), truth.has_value());
    if (!mine) continue;
    EXPECT_NEAR(mine->u, truth->u, 1e-4);
    EXPECT_NEAR(mine->v, truth->v, 1e-4);
  }
}

TEST(BallProjection, CameraRayKeepsFermatsPrinciple) {
  std::mt19937 random(11);
  double worst = 0;
  int seen = 0;
  for (const double d : {1.3, 1.5, 2., 3., 8., 12., 24., 100.}) {
    for (const double distance : {1.5, 3., 10., 40., kInfinity}) {
      for (const double off_axis : {0., 8., 25.}) {
        const CalibratedCamera camera = random_camera(random, d, off_axis);
        const auto ball = BallProjection::make(Kind::Exact, camera, kBall).value();
        for (int i = 0; i < 25; ++i) {
          const Vec3 v = random_direction(random);
          const auto truth = tests::fermat_ray(position_in_radii(camera), {RealVec3(v), distance});
          const auto pixel = ball.pixel(v, 1 / distance);
          ASSERT_EQ(pixel.has_value(), truth.has_value()) << "d " << d << " L " << distance;
          if (!truth) continue;
          ++seen;
          worst = std::max(worst, deviation(camera_ray(camera, *pixel), *truth));
        }
      }
    }
  }
  std::cout << "worst of " << seen << " camera rays: " << worst << " degrees\n";
  EXPECT_GT(seen, 1500);
  EXPECT_LT(worst, 1e-10);
}

TEST(BallProjection, APointIsSeenWhereItsDistanceSays) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> distance(1.2, 30);
  for (int i = 0; i < 300; ++i) {
    const CalibratedCamera camera = random_camera(random, distance(random), 10);
    const auto ball = BallProjection::make(Kind::Exact, camera, kBall).value();
    const Vec3 v = random_direction(random);
    const double away = distance(random);
    const auto truth = tests::fermat_ray(position_in_radii(camera), {RealVec3(v), away});
    const auto pixel = tests::pixel_of_point(ball, kBall.centre + v * (away * kBall.radius));
    ASSERT_EQ(pixel.has_value(), truth.has_value());
    if (pixel) {
      EXPECT_LT(deviation(camera_ray(camera, *pixel), *truth), 1e-10);
    }
    EXPECT_FALSE(tests::pixel_of_point(ball, kBall.centre + v * (0.9 * kBall.radius)));
  }
}

TEST(BallProjection, RayIsTheVectorReflection) {
  std::mt19937 random(13);
  double worst_direction = 0, worst_origin = 0;
  for (const double d : {1.3, 2., 12., 100.}) {
    for (const double off_axis : {0., 25.}) {
      const CalibratedCamera camera = random_camera(random, d, off_axis);
      const auto ball = BallProjection::make(Kind::Exact, camera, kBall).value();
      for (int i = 0; i < 300; ++i) {
        const auto pixel = ball.pixel(random_direction(random));
        if (!pixel) continue;
        const auto truth = tests::reflected(
            {position_in_radii(camera), tests::normalized(camera_ray(camera, *pixel))});
        const auto ray = ball.ray(*pixel);
        ASSERT_TRUE(truth && ray);
        const Vec3 origin = (ray->origin - kBall.centre) * (1 / kBall.radius);
        EXPECT_NEAR(norm(ray->direction), 1, 1e-12);
        // The hit point's error near the limb is the root of the camera ray's.
        const double incidence =
            -static_cast<double>(dot(tests::normalized(camera_ray(camera, *pixel)), truth->origin));
        const double stretch = std::min(1.0, incidence);
        worst_direction = std::max(worst_direction,
                                   stretch * deviation(RealVec3(ray->direction), truth->direction));
        worst_origin = std::max(worst_origin, stretch * norm(origin - rounded(truth->origin)));
      }
    }
  }
  std::cout << "worst reflected ray: " << worst_direction << " degrees, from " << worst_origin
            << " radii beside\n";
  EXPECT_LT(worst_direction, 1e-9);
  EXPECT_LT(worst_origin, 1e-11);
}

// A thing shown by a pixel is projected to that pixel, unless another part of the scene hides it
// from the ball's centre.
void expect_round_trips(const BallProjection& ball, std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  int trips = 0, hidden = 0;
  const Outline limb = ball.outline().value();
  const double radius = std::max(limb.rx, limb.ry);
  for (int i = 0; i < 300; ++i) {
    const Vec2 pixel{limb.centre.u + radius * coordinate(random),
                     limb.centre.v + radius * coordinate(random)};
    const auto direction = ball.direction(pixel);
    ASSERT_EQ(direction.has_value(), ball.ray(pixel).has_value());
    if (!direction) continue;
    ++trips;
    const Ray ray = ball.ray(pixel).value();
    const double scale = 1 / ball.ball().radius;
    const auto point =
        ball.proxy().meet({(ray.origin - ball.ball().centre) * scale, ray.direction});
    const double closeness = point ? 1 / norm(*point) : 0;
    if (std::abs(ball.proxy().hit(*direction).closeness - closeness) > 1e-9) {
      ++hidden;
      continue;
    }
    const auto again = ball.pixel(*direction);
    ASSERT_TRUE(again);
    EXPECT_NEAR(again->u, pixel.u, 1e-7);
    EXPECT_NEAR(again->v, pixel.v, 1e-7);
  }
  EXPECT_GT(trips, 100);
  EXPECT_LT(hidden, trips / 10);
}

TEST(BallProjection, RoundTripsInEveryScene) {
  std::mt19937 random(14);
  const Intrinsics wide{4000, 3000, 1200, 1200, 1990, 1510, Distortion::Fisheye, {0.02, -0.003}};
  using Room = Scene::Room;
  for (const Room room : {Room::None, Room::Sphere, Room::Plane, Room::Box}) {
    for (const bool obstacles : {false, true}) {
      const SceneProxy proxy = scene_around_ball(room, obstacles);
      CalibratedCamera camera = random_camera(random, 7, 8);
      expect_round_trips(BallProjection::make(Kind::Exact, camera, kBall, proxy).value(), random);
      camera.lens = Lens::make(wide).value();
      camera.window = Window{-camera.pose.rotation.row2 + camera.pose.rotation.row0 * 0.3, 12};
      expect_round_trips(BallProjection::make(Kind::Exact, camera, kBall, proxy).value(), random);
      expect_round_trips(BallProjection::make(model_at(9), {{700, 500}, 420, 400, 25},
                                              rotation({60, -20, 5}), kBall, proxy)
                             .value(),
                         random);
    }
  }
}

TEST(BallProjection, RoundTripsWithEveryModel) {
  std::mt19937 random(15);
  for (const Kind kind : {Kind::Exact, Kind::Paper, Kind::Classical}) {
    CalibratedCamera camera = random_camera(random, 12, 15);
    expect_round_trips(BallProjection::make(kind, camera, kBall).value(), random);
    camera.window = Window{camera.pose.rotation.row2, 10};
    expect_round_trips(BallProjection::make(kind, camera, kBall).value(), random);
  }
}

// The paper's and the classical law hold for tan psi / tan psi_max, about the axis to the ball.
TEST(BallProjection, OtherModelsAreTheirLawAboutTheAxis) {
  std::mt19937 random(16);
  const double d = 9;
  for (const Kind kind : {Kind::Paper, Kind::Classical}) {
    const BallModel model = BallModel::at_distance(kind, d);
    const CalibratedCamera camera = random_camera(random, d, 12);
    const auto ball =
        BallProjection::make(kind, camera, kBall, scene_around_ball(Scene::Room::Box, true));
    for (int i = 0; i < 200; ++i) {
      const Vec3 v = random_direction(random);
      const auto pixel = ball->pixel(v);
      const double phi = angle_between(v, ball->facing());
      ASSERT_EQ(pixel.has_value(), phi <= model.limit());
      if (!pixel) continue;
      const double psi = radians(deviation(camera_ray(camera, *pixel), RealVec3(-ball->facing())));
      const double stretch = kind == Kind::Paper ? std::sin(model.limit() / 2) : 1;
      EXPECT_NEAR(std::tan(psi) * std::sqrt(d * d - 1), std::sin(phi / 2) / stretch, 1e-12);
      EXPECT_LT(norm(ball->ray(*pixel)->origin - kBall.centre), 1e-12);
    }
  }
}

// The same ball with and without calibration: a camera on its axis has a circle for a limb.
TEST(BallProjection, WithAndWithoutCalibrationAgree) {
  std::mt19937 random(17);
  const double d = 6, focal = 2000;
  const Lens lens = Lens::make({2000, 2000, focal, focal, 900, 950}).value();
  const Pose pose{{{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, kBall.centre + Vec3{0, d * 50, 0}};
  const double radius = focal / std::sqrt(d * d - 1);
  const SceneProxy proxy = scene_around_ball(Scene::Room::Box, true);
  const auto calibrated = BallProjection::make(Kind::Exact, {lens, pose, {}}, kBall, proxy).value();
  const auto simple =
      BallProjection::make(model_at(d), {{900, 950}, radius, radius, 0}, {}, kBall, proxy).value();
  EXPECT_NEAR(simple.distance(), calibrated.distance(), 1e-12);
  EXPECT_LT(norm(simple.facing() - calibrated.facing()), 1e-15);
  const Outline limb = calibrated.outline().value();
  EXPECT_NEAR(limb.rx, radius, 1e-6);
  EXPECT_NEAR(limb.centre.u, 900, 1e-6);
  for (int i = 0; i < 500; ++i) {
    const Vec3 v = random_direction(random);
    const auto a = calibrated.pixel(v), b = simple.pixel(v);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_LT(std::hypot(a->u - b->u, a->v - b->v), 1e-9);
    }
  }
}

// A turn about the axis or a reflection in a plane through it turns or mirrors the room's picture.
TEST(BallProjection, IsSymmetricAboutTheAxis) {
  std::mt19937 random(18);
  const auto ball = BallProjection::make(model_at(5), {{0, 0}, 100, 100, 0}, {}).value();
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (int i = 0; i < 500; ++i) {
    const Vec3 v = random_direction(random);
    const double closeness = 0.4 * (i % 2);
    const auto pixel = ball.pixel(v, closeness);
    const auto turned = ball.pixel({c * v.x - s * v.z, v.y, s * v.x + c * v.z}, closeness);
    const auto mirrored = ball.pixel({-v.x, v.y, v.z}, closeness);
    ASSERT_EQ(pixel.has_value(), turned.has_value());
    ASSERT_EQ(pixel.has_value(), mirrored.has_value());
    if (!pixel) continue;
    // u increases along -X, v along -Z.
    EXPECT_NEAR(turned->u, c * pixel->u - s * pixel->v, 1e-11);
    EXPECT_NEAR(turned->v, s * pixel->u + c * pixel->v, 1e-11);
    EXPECT_NEAR(mirrored->u, -pixel->u, 1e-12);
    EXPECT_NEAR(mirrored->v, pixel->v, 1e-12);
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
    // A pixel's share of the sphere near the limb grows without bound, and rounding with it.
    EXPECT_LT(angle_between(*again, v), 1e-6);
  }
}

TEST(BallProjection, RefusesWhatIsNoEllipse) {
  const double nan = std::nan("");
  const BallModel model = BallModel::make(BallModel::Kind::Classical).value();
  for (const Outline& bad :
       {Outline{{0, 0}, 0, 10, 0}, Outline{{0, 0}, 10, -1, 0}, Outline{{nan, 0}, 10, 10, 0},
        Outline{{0, 0}, nan, 10, 0}, Outline{{0, 0}, 10, 10, nan}}) {
    EXPECT_FALSE(BallProjection::make(model, bad, {}));
  }
  EXPECT_FALSE(BallProjection::make(model, {{0, 0}, 10, 10, 0}, {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

// Light from the camera, traced through both surfaces of a tilted glass and off the ball.
TEST(BallProjection, AWindowIsSnellsLawTwice) {
  std::mt19937 random(19);
  CalibratedCamera camera = random_camera(random, 10, 6);
  const Vec3 tilted = normalized(camera.pose.rotation.row2 + camera.pose.rotation.row1 * 0.4);
  const Window window{tilted * -3, 25, 1.52};
  const auto bare = BallProjection::make(Kind::Exact, camera, kBall).value();
  camera.window = window;
  const auto ball = BallProjection::make(Kind::Exact, camera, kBall).value();
  double shifted = 0;
  for (int i = 0; i < 500; ++i) {
    const auto pixel = ball.pixel(random_direction(random));
    if (!pixel) continue;
    const tests::Real depth = dot(position_in_radii(camera), RealVec3(tilted)) + 1.5;
    const auto behind = tests::through_glass(
        {position_in_radii(camera), tests::normalized(camera_ray(camera, *pixel))},
        RealVec3(tilted), depth, window.thickness / kBall.radius, window.index);
    const auto truth = tests::reflected(behind).value();
    const Ray ray = ball.ray(*pixel).value();
    EXPECT_LT(deviation(RealVec3(ray.direction), truth.direction), 1e-6);
    const Vec3 origin = (ray.origin - kBall.centre) * (1 / kBall.radius);
    EXPECT_LT(norm(origin - rounded(truth.origin)), 1e-8);
    // The inverse: a point on that ray is projected to that pixel.
    const auto again = tests::pixel_of_point(ball, ray.origin + ray.direction * 70);
    ASSERT_TRUE(again);
    EXPECT_LT(std::hypot(again->u - pixel->u, again->v - pixel->v), 1e-7);
    if (const auto other = tests::pixel_of_point(bare, ray.origin + ray.direction * 70)) {
      shifted = std::max(shifted, std::hypot(other->u - pixel->u, other->v - pixel->v));
    }
  }
  EXPECT_GT(shifted, 10);
}

TEST(BallProjection, OutlineIsWhereTheBallEnds) {
  std::mt19937 random(20);
  CalibratedCamera camera = random_camera(random, 8, 20);
  for (const bool window : {false, true}) {
    if (window) camera.window = Window{{1, 2, 3}, 10};
    const auto ball = BallProjection::make(Kind::Exact, camera, kBall).value();
    const Outline limb = ball.outline().value();
    for (double t = 0; t < 6.28; t += 0.1) {
      double shown = 0.9995, hidden = 1.0005;
      ASSERT_TRUE(ball.ray(point_on(limb, shown, t)));
      ASSERT_FALSE(ball.ray(point_on(limb, hidden, t)));
      for (int i = 0; i < 30; ++i) {
        const double middle = (shown + hidden) / 2;
        (ball.ray(point_on(limb, middle, t)) ? shown : hidden) = middle;
      }
      // Directions end at the limb too.
      const Vec3 last = ball.ray(point_on(limb, shown - 1e-9, t)).value().direction;
      EXPECT_TRUE(ball.pixel(last));
      EXPECT_FALSE(ball.pixel(normalized(last - ball.facing() * 0.1)));
    }
  }
}

TEST(BallProjection, RefusesImpossibleCameras) {
  std::mt19937 random(21);
  const CalibratedCamera good = random_camera(random, 5, 0);
  const auto reason = [](const CalibratedCamera& camera, const Ball& ball = kBall) {
    const auto projection = BallProjection::make(Kind::Exact, camera, ball);
    return projection ? "" : projection.error().message;
  };
  EXPECT_THAT(reason(good, {kBall.centre, 0}), testing::HasSubstr("radius"));
  EXPECT_THAT(reason(good, {{std::nan(""), 0, 0}, 1}), testing::HasSubstr("centre"));
  EXPECT_THAT(reason(good, {kBall.centre, 250.001}), testing::HasSubstr("inside of the ball"));
  CalibratedCamera camera = good;
  camera.pose.position.x = std::nan("");
  EXPECT_THAT(reason(camera), testing::HasSubstr("position"));
  camera = good;
  camera.pose.rotation.row0 = -camera.pose.rotation.row0;
  EXPECT_THAT(reason(camera), testing::HasSubstr("not a rotation"));
  camera.pose.rotation.row2 = -camera.pose.rotation.row2;  // looks away from the ball
  EXPECT_THAT(reason(camera), testing::HasSubstr("looks another way"));
  camera = good;
  camera.window = Window{{0, 0, 0}, 5};
  EXPECT_THAT(reason(camera), testing::HasSubstr("normal"));
  camera.window = Window{{0, 1, 0}, 201};
  EXPECT_THAT(reason(camera), testing::HasSubstr("fit between"));
}

TEST(BallProjection, NothingIsShownOfNoDirection) {
  std::mt19937 random(22);
  const double nan = std::nan("");
  const SceneProxy proxy = scene_around_ball(Scene::Room::Box, true);
  const auto ball =
      BallProjection::make(Kind::Exact, random_camera(random, 5, 0), kBall, proxy).value();
  EXPECT_FALSE(ball.pixel({nan, 0, 0}));
  EXPECT_FALSE(tests::pixel_of_point(ball, {nan, 0, 0}));
  EXPECT_FALSE(ball.ray({nan, 0}));
}

}  // namespace
}  // namespace orbwatch::optics
