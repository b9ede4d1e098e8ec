// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/view_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <random>

#include "proc/optics/vec.h"

namespace orbwatch::optics {
namespace {

constexpr std::array kTurnable{ViewKind::Perspective, ViewKind::Equirectangular,
                               ViewKind::Cylindrical, ViewKind::Stereographic, ViewKind::Fisheye};

ViewSpec perspective(double yaw, double pitch, double roll, double h_fov) {
  return {ViewKind::Perspective, {yaw, pitch, roll}, h_fov, {}, 641, 481};
}

double deviation(const Vec3& a, const Vec3& b) { return degrees(angle_between(a, b)); }

/// The direction at that longitude and latitude, degrees.
Vec3 on_globe(double lon, double lat) {
  return {std::cos(radians(lat)) * std::sin(radians(lon)),
          std::cos(radians(lat)) * std::cos(radians(lon)), std::sin(radians(lat))};
}

/// The direction `theta` away from straight ahead, `turn` from right towards up, degrees.
Vec3 around_axis(double theta, double turn) {
  return {std::sin(radians(theta)) * std::cos(radians(turn)), std::cos(radians(theta)),
          std::sin(radians(theta)) * std::sin(radians(turn))};
}

BallProjection tilted_ball() {
  return BallProjection::make(BallModel::make(BallModel::Kind::Exact, 345).value(),
                              {{310, 250}, 120, 100, 30}, rotation({40, -20, 10}))
      .value();
}

TEST(ViewProjection, PerspectiveSpansEdgeToEdge) {
  const auto view = ViewProjection::make(perspective(0, 0, 0, 90)).value();
  EXPECT_LT(deviation(*view.direction(320, 240), {0, 1, 0}), 1e-9);
  EXPECT_LT(deviation(*view.direction(640.5, 240), {1, 1, 0}), 1e-9);  // +X is on the right
  EXPECT_GT(view.direction(320, 0)->z, 0);
}

TEST(ViewProjection, EquirectangularIsLinearInLongitudeAndLatitude) {
  const auto view = ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 360, 180}).value();
  for (const auto& [lon, lat] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {-120.0, 45.0}, {10.0, -80.0}}) {
    EXPECT_LT(deviation(*view.direction(lon + 179.5, 89.5 - lat), on_globe(lon, lat)), 1e-9);
  }
}

TEST(ViewProjection, CylindricalIsLinearInLongitudeAndTangentOfLatitude) {
  const auto view = ViewProjection::make({ViewKind::Cylindrical, {}, 180, 90, 180, 101}).value();
  for (const auto& [lon, lat] : {std::pair{0.0, 0.0}, {90.0, 30.0}, {-80.0, 45.0}, {10.0, -44.0}}) {
    const double v = 50 - 50.5 * std::tan(radians(lat));
    EXPECT_LT(deviation(*view.direction(lon + 89.5, v), on_globe(lon, lat)), 1e-9);
  }
  // Square pixels: a step up on the horizon equals a step to the right.
  const auto square = ViewProjection::make({ViewKind::Cylindrical, {}, {}, {}, 361, 181}).value();
  EXPECT_NEAR(deviation(*square.direction(180, 89), *square.direction(180, 91)),
              deviation(*square.direction(179, 90), *square.direction(181, 90)), 1e-3);
}

TEST(ViewProjection, StereographicHasTheTangentOfTheHalfAngle) {
  const auto view = ViewProjection::make({ViewKind::Stereographic, {}, 270, {}, 401, 401}).value();
  const double f = 200.5 / (2 * std::tan(radians(270.0 / 4)));
  for (const double theta : {0.0, 20.0, 90.0, 134.0}) {
    for (const double turn : {0.0, 77.0, -130.0}) {
      const double r = 2 * f * std::tan(radians(theta / 2));
      EXPECT_LT(deviation(*view.direction(200 + r * std::cos(radians(turn)),
                                          200 - r * std::sin(radians(turn))),
                          around_axis(theta, turn)),
                1e-9);
    }
  }
}

TEST(ViewProjection, FisheyeIsLinearInTheAngleAndEndsBehind) {
  const auto view = ViewProjection::make({ViewKind::Fisheye, {}, 360, {}, 361, 361}).value();
  const double per_degree = 361.0 / 360;
  for (const double theta : {0.0, 20.0, 90.0, 179.0}) {
    for (const double turn : {0.0, 77.0, -130.0}) {
      EXPECT_LT(deviation(*view.direction(180 + per_degree * theta * std::cos(radians(turn)),
                                          180 - per_degree * theta * std::sin(radians(turn))),
                          around_axis(theta, turn)),
                1e-9);
    }
  }
  EXPECT_TRUE(view.direction(360.499, 180));
  EXPECT_FALSE(view.direction(360.6, 180));
  EXPECT_FALSE(view.direction(0, 0));
  EXPECT_EQ(view.solid_angle(0, 0), 0);
}

TEST(ViewProjection, ABallViewIsTheCamerasPictureCutToTheLimb) {
  const BallProjection ball = tilted_ball();
  const auto view = ViewProjection::make({ViewKind::Ball, {}, {}, {}, 300, 240}, ball).value();
  EXPECT_LT(deviation(*view.direction(149.5, 119.5), *ball.direction({310, 250})), 1e-9);
  // The limb fits with a small margin: nothing is shown on the border, something just within.
  double left = 300, right = 0, top = 240, bottom = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 300; ++x) {
      if (!view.direction(x, y)) continue;
      left = std::min<double>(left, x), right = std::max<double>(right, x);
      top = std::min<double>(top, y), bottom = std::max<double>(bottom, y);
    }
  }
  EXPECT_GT(std::min({left, 299 - right, top, 239 - bottom}), 0);
  EXPECT_LT(std::min({left, 299 - right, top, 239 - bottom}), 6);
  // Pixels are square and oriented like the camera's picture.
  const Vec2 a = ball.pixel(*view.direction(100, 100)).value();
  const Vec2 b = ball.pixel(*view.direction(110, 100)).value();
  const Vec2 c = ball.pixel(*view.direction(100, 110)).value();
  EXPECT_GT(b.u - a.u, 0);
  EXPECT_NEAR(b.u - a.u, c.v - a.v, 1e-6);
  EXPECT_NEAR(b.v, a.v, 1e-6);
  EXPECT_NEAR(c.u, a.u, 1e-6);
}

TEST(ViewProjection, AWholePictureHasTheCamerasPixels) {
  const BallProjection ball = tilted_ball();
  const auto view = ViewProjection::whole_picture(ball, 640, 480).value();
  EXPECT_EQ(view.kind(), ViewKind::Ball);
  EXPECT_EQ(view.width(), 640);
  for (const Vec2 pixel : {Vec2{293, 237}, Vec2{270, 301}}) {
    const Vec2 shown = view.of_camera_pixel(pixel);
    EXPECT_NEAR(shown.u, pixel.u, 1e-9);
    EXPECT_NEAR(shown.v, pixel.v, 1e-9);
    EXPECT_LT(deviation(*view.direction(pixel.u, pixel.v), *ball.direction(pixel)), 1e-12);
  }
  EXPECT_FALSE(view.direction(1, 1)) << "beside the ball";
  EXPECT_FALSE(ViewProjection::whole_picture(ball, 0, 480));
}

TEST(ViewProjection, ABallViewOfTheCamerasSizeHasTheCamerasPixels) {
  const BallProjection ball = tilted_ball();
  const Outline limb = ball.outline().value();
  const double c = std::cos(radians(limb.angle)), s = std::sin(radians(limb.angle));
  const double half =
      std::max(std::hypot(limb.rx * c, limb.ry * s), std::hypot(limb.rx * s, limb.ry * c));
  for (const double share : {0.995, 1.0, 1.005, 1.1}) {
    const int size = static_cast<int>(std::lround(2.04 * half * share));
    const auto view = ViewProjection::make({ViewKind::Ball, {}, {}, {}, size, size}, ball).value();
    for (const Vec2 pixel : {Vec2{293, 237}, Vec2{270, 301}}) {
      const Vec2 shown = view.of_camera_pixel(pixel);
      const bool is_one = std::abs(shown.u - std::round(shown.u)) < 1e-9 &&
                          std::abs(shown.v - std::round(shown.v)) < 1e-9;
      EXPECT_EQ(is_one, share < 1.05) << size << ": " << shown.u << " " << shown.v;
      EXPECT_LT(deviation(*view.direction(shown.u, shown.v), *ball.direction(pixel)), 1e-9);
    }
  }
}

TEST(ViewProjection, PixelIsTheInverseOfDirection) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-180, 180), share(0, 1);
  for (int round = 0; round < 200; ++round) {
    for (const ViewKind kind : kTurnable) {
      const double widest = kind == ViewKind::Perspective     ? 170
                            : kind == ViewKind::Stereographic ? 340
                                                              : 360;
      const ViewSpec spec{
          kind,
          {angle(random), angle(random), angle(random)},
          1 + (widest - 1) * share(random),
          share(random) < 0.5 ? std::optional(1 + 150 * share(random)) : std::nullopt,
          640,
          480};
      const auto view = ViewProjection::make(spec).value();
      for (int i = 0; i < 20; ++i) {
        const double u = -0.49 + 639.98 * share(random), v = -0.49 + 479.98 * share(random);
        const auto direction = view.direction(u, v);
        if (!direction) continue;
        EXPECT_NEAR(norm(*direction), 1, 1e-12);
        const auto pixel = view.pixel(*direction);
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->u, u, 1e-4) << static_cast<int>(kind);
        EXPECT_NEAR(pixel->v, v, 1e-4) << static_cast<int>(kind);
      }
    }
  }
}

TEST(ViewProjection, PixelOfABallViewIsTheInverseToo) {
  const auto view =
      ViewProjection::make({ViewKind::Ball, {}, {}, {}, 300, 240}, tilted_ball()).value();
  int shown = 0;
  for (int y = 0; y < 240; y += 7) {
    for (int x = 0; x < 300; x += 7) {
      const auto direction = view.direction(x, y);
      if (!direction) continue;
      ++shown;
      const auto pixel = view.pixel(*direction);
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->u, x, 1e-6);
      EXPECT_NEAR(pixel->v, y, 1e-6);
    }
  }
  EXPECT_GT(shown, 500);
}

TEST(ViewProjection, EveryKindTurnsByYawPitchRollAndIsUnmirrored) {
  for (const ViewKind kind : kTurnable) {
    const auto view = [&](double yaw, double pitch, double roll) {
      return ViewProjection::make({kind, {yaw, pitch, roll}, 60, 60, 641, 641}).value();
    };
    EXPECT_LT(deviation(*view(90, 0, 0).direction(320, 320), {1, 0, 0}), 1e-9);
    EXPECT_NEAR(view(0, 30, 0).direction(320, 320)->z, 0.5, 1e-12);
    const auto ahead = view(0, 0, 0);
    EXPECT_GT(ahead.direction(600, 320)->x, 0.3);  // +X is on the right
    EXPECT_NEAR(ahead.direction(600, 320)->z, 0, 1e-12);
    EXPECT_GT(ahead.direction(320, 40)->z, 0.3);  // +Z is up
    // A positive roll makes the right side dip: right = (cos 10, 0, -sin 10).
    const Vec3 right = *view(0, 0, 10).direction(600, 320);
    EXPECT_NEAR(right.z / right.x, -std::tan(radians(10)), 1e-9) << static_cast<int>(kind);
  }
}

TEST(ViewProjection, ShowsNothingWhereAProjectionHasNoPlace) {
  const auto make = [](ViewKind kind) {
    return ViewProjection::make({kind, {}, {}, {}, 64, 64}).value();
  };
  EXPECT_FALSE(make(ViewKind::Perspective).pixel({0, -1, 0}));
  EXPECT_FALSE(make(ViewKind::Perspective).pixel({1, 0, 0}));
  EXPECT_FALSE(make(ViewKind::Cylindrical).pixel({0, 0, 1}));
  EXPECT_FALSE(make(ViewKind::Stereographic).pixel({0, -1, 0}));
  EXPECT_FALSE(make(ViewKind::Fisheye).pixel({0, -1, 0}));
  EXPECT_TRUE(make(ViewKind::Equirectangular).pixel({0, 0, 1}));
}

double total_solid_angle(const ViewSpec& spec) {
  const auto view = ViewProjection::make(spec, tilted_ball()).value();
  double total = 0;
  for (int v = 0; v < spec.height; ++v) {
    for (int u = 0; u < spec.width; ++u) total += view.solid_angle(u, v);
  }
  return total;
}

TEST(ViewProjection, SolidAnglesAddUp) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(total_solid_angle({ViewKind::Equirectangular, {}, {}, {}, 512, 256}), 4 * kPi, 1e-3);
  // A square view of 90 degrees is one of a cube's six faces.
  EXPECT_NEAR(total_solid_angle({ViewKind::Perspective, {}, 90, {}, 400, 400}), 4 * kPi / 6, 1e-3);
  // A belt between the latitudes -45 and 45.
  EXPECT_NEAR(total_solid_angle({ViewKind::Cylindrical, {}, {}, 90, 512, 256}),
              4 * kPi * std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(total_solid_angle({ViewKind::Fisheye, {}, 360, {}, 512, 512}), 4 * kPi, 1e-3);
  // Round pictures: the square's corners add nothing here, as almost all directions are covered.
  EXPECT_NEAR(total_solid_angle({ViewKind::Stereographic, {}, 355, {}, 4000, 4000}), 4 * kPi, 0.01);
  // A Ball view shows all but the blind cone, whose half angle is 180 - alpha/2.
  EXPECT_NEAR(total_solid_angle({ViewKind::Ball, {}, {}, {}, 1000, 1000}),
              2 * kPi * (1 - std::cos(radians(345.0 / 2))), 0.15);
}

TEST(ViewProjection, SolidAngleIsWhatThePixelsCornersEnclose) {
  for (const ViewKind kind : kTurnable) {
    const auto view = ViewProjection::make({kind, {20, 30, 40}, 150, 100, 320, 240}).value();
    for (const auto& [u, v] : {std::pair{10.0, 20.0}, {160.0, 119.5}, {300.0, 200.0}}) {
      const Vec3 a = *view.direction(u - 0.5, v - 0.5), b = *view.direction(u + 0.5, v - 0.5);
      const Vec3 c = *view.direction(u + 0.5, v + 0.5), d = *view.direction(u - 0.5, v + 0.5);
      const double enclosed = norm(cross(c - a, d - b)) / 2;
      EXPECT_NEAR(view.solid_angle(u, v) / enclosed, 1, 1e-3) << static_cast<int>(kind);
    }
  }
}

TEST(ViewProjection, CameraInfoOfAPerspectiveViewProjectsLikeIt) {
  const auto view = ViewProjection::make({ViewKind::Perspective, {}, 100, 50, 640, 480}).value();
  const Intrinsics k = view.intrinsics().value();
  EXPECT_EQ(k.width, 640);
  EXPECT_EQ(k.height, 480);
  EXPECT_NEAR(k.fx, 320 / std::tan(radians(50)), 1e-9);
  EXPECT_NEAR(k.fy, 240 / std::tan(radians(25)), 1e-9);
  EXPECT_EQ(k.cx, 319.5);
  EXPECT_EQ(k.cy, 239.5);
  EXPECT_EQ(k.distortion, Distortion::None);
  const Vec3 d = *view.direction(123, 45);  // camera frame: x = X, y = -Z, z = Y
  EXPECT_NEAR(k.fx * d.x / d.y + k.cx, 123, 1e-9);
  EXPECT_NEAR(k.fy * -d.z / d.y + k.cy, 45, 1e-9);
  EXPECT_FALSE(ViewProjection::make({ViewKind::Fisheye, {}, 90, {}, 8, 8})->intrinsics());
}

TEST(ViewProjection, RefusesImpossibleViews) {
  const double nan = std::nan("");
  const auto refused = [](const ViewSpec& spec) { return !ViewProjection::make(spec).has_value(); };
  EXPECT_TRUE(refused({ViewKind::Perspective, {}, {}, {}, 0, 10}));
  EXPECT_TRUE(refused({ViewKind::Perspective, {}, {}, {}, 10, 16385}));
  EXPECT_TRUE(refused(perspective(nan, 0, 0, 90)));
  EXPECT_FALSE(refused({ViewKind::Perspective, {}, 179, {}, 1, 1}));
  struct Limit {
    ViewKind kind;
    double h, v;
    bool h_included, v_included;
  };
  for (const Limit& limit : {Limit{ViewKind::Perspective, 180, 180, false, false},
                             {ViewKind::Equirectangular, 360, 180, true, true},
                             {ViewKind::Cylindrical, 360, 180, true, false},
                             {ViewKind::Stereographic, 360, 360, false, false},
                             {ViewKind::Fisheye, 360, 360, true, true}}) {
    const auto h = [&](double fov) { return refused({limit.kind, {}, fov, {}, 10, 10}); };
    const auto v = [&](double fov) { return refused({limit.kind, {}, {}, fov, 10, 10}); };
    for (const double fov : {0.0, -1.0, 1e-300, 361.0, nan}) {
      EXPECT_TRUE(h(fov)) << static_cast<int>(limit.kind) << ' ' << fov;
      EXPECT_TRUE(v(fov)) << static_cast<int>(limit.kind) << ' ' << fov;
    }
    EXPECT_EQ(h(limit.h), !limit.h_included) << static_cast<int>(limit.kind);
    EXPECT_EQ(v(limit.v), !limit.v_included) << static_cast<int>(limit.kind);
    EXPECT_FALSE(h(limit.h - 0.001));
    EXPECT_FALSE(v(limit.v - 0.001));
  }
  const Error error = ViewProjection::make(perspective(0, 0, 0, 180)).error();
  EXPECT_EQ(error.message,
            "the view's h_fov is 180.000000 degrees; it must be above 0 and below 180");
}

TEST(ViewProjection, ABallViewNeedsACameraAndNoAngles) {
  const BallProjection ball = tilted_ball();
  const ViewSpec spec{ViewKind::Ball, {}, {}, {}, 64, 64};
  EXPECT_FALSE(ViewProjection::make(spec));
  EXPECT_TRUE(check_view(spec));
  EXPECT_TRUE(ViewProjection::make(spec, ball));
  EXPECT_FALSE(ViewProjection::make({ViewKind::Ball, {}, 90, {}, 64, 64}, ball));
  EXPECT_FALSE(ViewProjection::make({ViewKind::Ball, {}, {}, 90, 64, 64}, ball));
  EXPECT_FALSE(ViewProjection::make({ViewKind::Ball, {10, 0, 0}, {}, {}, 64, 64}, ball));
  EXPECT_FALSE(ViewProjection::make({ViewKind::Ball, {}, {}, {}, 64, 0}, ball));
}

}  // namespace
}  // namespace orbwatch::optics
