// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "proc/optics/vec.h"

namespace orbwatch::optics {
namespace {

constexpr std::array<double, 8> kStraight{};

Lens lens(double focal, Distortion distortion = Distortion::None,
          const std::array<double, 8>& coefficients = kStraight) {
  return Lens::make({1500, 1500, focal, focal, 749.5, 749.5, distortion, coefficients}).value();
}

BallSight sight(double off, double around, double distance) {
  const double a = radians(off), b = radians(around);
  return {{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)}, distance};
}

/// Cameras of a rendered scene with known outlines: pose and outline as stated by the scene, pixel
/// centres moved to integers.
struct KnownOutline {
  double focal;
  Vec2 principal;
  BallSight sight;
  Outline outline;
};

const KnownOutline kOffAxis{
    2678.823202452898,
    {749.5, 749.5},
    {normalized(Mat3{{-0.46223392641943134, 0.8867580263334952, 0},
                     {0.26541138286770827, 0.13834906702407793, -0.9541573945098462},
                     {-0.8461067279670613, -0.4410439188864205, -0.29930530650521725}} *
                Vec3{120 - 480.9033891243016, 60 - 200.35131799278392, 430 - 530.2509414234171}),
     8},
    {{1039.762979707179, 615.5496841555724},
     342.23022728949474,
     339.8568841589122,
     155.22766058224298 - 180}};
const KnownOutline kNearAxis{
    7892.452090446923,
    {749.5, 749.5},
    {normalized(Mat3{{0.988276260905051, 0.1526762330277092, 0},
                     {0.015422978928136736, -0.09983324611074251, -0.9948846439120336},
                     {-0.15189523972960314, 0.9832208759172378, -0.101017549505152}} *
                Vec3{120 - 208.5722096349221, 60 + 530.4813975661475, 430 - 489.0481397566148}),
     12},
    {{784.1874616683955, 728.708233012779},
     660.0172087255522,
     660.0086043066958,
     149.0614031977561 - 180}};

TEST(Outline, IsTheOneOfTheRenderedScenes) {
  for (const KnownOutline& known : {kOffAxis, kNearAxis}) {
    const Lens l = Lens::make({1500, 1500, known.focal, known.focal, known.principal.u,
                               known.principal.v, Distortion::None, kStraight})
                       .value();
    const Outline outline = outline_from_sight(known.sight, l).value();
    EXPECT_NEAR(outline.centre.u, known.outline.centre.u, 1e-7);
    EXPECT_NEAR(outline.centre.v, known.outline.centre.v, 1e-7);
    EXPECT_NEAR(outline.rx, known.outline.rx, 1e-7);
    EXPECT_NEAR(outline.ry, known.outline.ry, 1e-7);
    EXPECT_NEAR(outline.angle, known.outline.angle, 1e-3);
    const BallSight found = sight_from_outline(known.outline, l).value();
    EXPECT_LT(angle_between(found.axis, known.sight.axis), 1e-9);
    EXPECT_NEAR(found.distance, known.sight.distance, 1e-8);
  }
}

TEST(Outline, SightComesBackFromIt) {
  const Lens l = lens(1000);
  for (const double distance : {1.3, 1.5, 2.0, 5.0, 12.0, 100.0, 1000.0}) {
    const double limb = degrees(std::asin(1 / distance));
    for (const double off : {0.0, 1e-7, 0.1, 10.0, 30.0, 60.0}) {
      if (off + limb > 85) continue;
      for (const double around : {0.0, 77.0, 200.0}) {
        const BallSight seen = sight(off, around, distance);
        const Outline outline = outline_from_sight(seen, l).value();
        EXPECT_GE(outline.rx, outline.ry);
        const BallSight found = sight_from_outline(outline, l).value();
        EXPECT_LT(angle_between(found.axis, seen.axis), 1e-9) << distance << " at " << off;
        EXPECT_NEAR(found.distance / distance, 1, 1e-9) << distance << " at " << off;
      }
    }
  }
}

TEST(Outline, EveryPointOfItLiesOnTheLimb) {
  const Lens l = lens(800);
  const BallSight seen = sight(25, 130, 2);
  const Outline outline = outline_from_sight(seen, l).value();
  const double c = std::cos(radians(outline.angle)), s = std::sin(radians(outline.angle));
  for (int i = 0; i < 100; ++i) {
    const double t = 2 * std::numbers::pi * i / 100;
    const double along = outline.rx * std::cos(t), beside = outline.ry * std::sin(t);
    const Vec3 ray = l.direction({outline.centre.u + along * c - beside * s,
                                  outline.centre.v + along * s + beside * c})
                         .value();
    EXPECT_NEAR(angle_between(ray, seen.axis), std::asin(1.0 / 2), 1e-11);
  }
}

TEST(Outline, HasItsLongAxisAwayFromTheCentre) {
  // A ball off the optical axis is stretched radially, with the factor 1 / cos(off) for a far one.
  const Outline outline = outline_from_sight(sight(40, 30, 500), lens(3000)).value();
  EXPECT_NEAR(outline.angle, 30, 1e-4);
  EXPECT_NEAR(outline.rx / outline.ry, 1 / std::cos(radians(40)), 1e-4);
}

TEST(Outline, FitsThroughADistortedLens) {
  const Lens barrel = lens(1500, Distortion::Pinhole, {-0.15, 0.03, 5e-4, -3e-4, 0, 0, 0, 0});
  const Lens fisheye = lens(600, Distortion::Fisheye, {-0.02, 0.003, 0, 0, 0, 0, 0, 0});
  for (const Lens& l : {barrel, fisheye}) {
    for (const double off : {0.0, 5.0, 12.0}) {
      const BallSight seen = sight(off, 40, 10);
      const Outline outline = outline_from_sight(seen, l).value();
      const BallSight found = sight_from_outline(outline, l).value();
      EXPECT_LT(degrees(angle_between(found.axis, seen.axis)), 2e-3) << off;
      EXPECT_NEAR(found.distance, seen.distance, 0.01) << off;
    }
  }
}

TEST(Outline, FisheyeSeesABallThatFillsItsView) {
  const Lens fisheye = lens(300, Distortion::Fisheye);
  const BallSight near{{0, 0, 1}, 1.05};  // 72 degrees to the limb
  const Outline outline = outline_from_sight(near, fisheye).value();
  EXPECT_NEAR(outline.rx, 300 * std::asin(1 / 1.05), 1e-9);
  EXPECT_NEAR(sight_from_outline(outline, fisheye)->distance, 1.05, 1e-12);
  // A direction sideways of the camera, where a pinhole sees nothing.
  EXPECT_TRUE(outline_from_sight(sight(90, 0, 5), fisheye));
}

TEST(Outline, WindowBringsTheBallNearer) {
  // A glass across the axis acts as if the camera were t (1 - 1/n) nearer: by 3.42 % of the ball's
  // radius here, to first order in the limb's angle.
  const Lens l = lens(3000);
  const Window glass{{0, 0, 1}, 0.1, 1.52};
  const Outline bare = outline_from_sight(sight(0, 0, 20 - 0.1 * (1 - 1 / 1.52)), l).value();
  const Outline behind = outline_from_sight(sight(0, 0, 20), l, glass).value();
  EXPECT_NEAR(behind.rx / bare.rx, 1, 1e-5);
  EXPECT_NEAR(sight_from_outline(bare, l, glass)->distance, 20, 1e-3);
}

TEST(Outline, LimbTouchesTheBallThroughATiltedWindow) {
  const Lens l = lens(1500);
  const Window glass{{0.3, -0.2, 1}, 0.3, 1.5};
  const BallSight seen = sight(12, 60, 6);
  const Outline outline = outline_from_sight(seen, l, glass).value();
  const double c = std::cos(radians(outline.angle)), s = std::sin(radians(outline.angle));
  for (int i = 0; i < 16; ++i) {
    const double t = 2 * std::numbers::pi * i / 16;
    const double along = outline.rx * std::cos(t), beside = outline.ry * std::sin(t);
    const Vec3 ray = l.direction({outline.centre.u + along * c - beside * s,
                                  outline.centre.v + along * s + beside * c})
                         .value();
    const Vec3 towards = seen.axis * seen.distance - displacement(glass, ray);
    EXPECT_NEAR(norm(cross(ray, towards)), 1, 1e-4) << "distance of the ray from the centre";
  }
  const BallSight found = sight_from_outline(outline, l, glass).value();
  EXPECT_LT(angle_between(found.axis, seen.axis), 1e-6);
  EXPECT_NEAR(found.distance, seen.distance, 1e-4);
  EXPECT_GT(std::abs(sight_from_outline(outline, l)->distance - seen.distance), 0.05);
}

TEST(Outline, SightForgivesNoiseButNoOtherShape) {
  const Lens l = lens(3000);
  const Outline outline = outline_from_sight(sight(5, 0, 10), l).value();
  Outline rough = outline;
  rough.rx *= 1.003;
  rough.centre.u += 0.3;
  EXPECT_NEAR(sight_from_outline(rough, l)->distance, 10, 0.03);
  Outline flat = outline;
  flat.ry *= 0.8;
  EXPECT_FALSE(sight_from_outline(flat, l));
}

TEST(Outline, RefusesWhatTheLensCannotShow) {
  EXPECT_FALSE(outline_from_sight(sight(45, 0, 1.2), lens(1000))) << "limb beyond 90 degrees";
  EXPECT_FALSE(outline_from_sight(sight(180, 0, 10), lens(1000)));
  EXPECT_FALSE(outline_from_sight(sight(0, 0, 1), lens(1000))) << "the camera touches the ball";
  EXPECT_FALSE(outline_from_sight(sight(0, 0, 0.5), lens(1000)));
  EXPECT_FALSE(outline_from_sight(sight(0, 0, std::nan("")), lens(1000)));
  EXPECT_FALSE(
      outline_from_sight(sight(0, 0, std::numeric_limits<double>::infinity()), lens(1000)));
  const Lens barrel = lens(1000, Distortion::Pinhole, {-0.3, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_FALSE(sight_from_outline({{700, 700}, 800, 800, 0}, barrel)) << "beyond the fold";
}

TEST(Outline, RefusesWhatIsNoEllipse) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(check_ellipse({{-10, 3}, 5, 5, 720}));
  for (const Outline& wrong :
       {Outline{{nan, 0}, 5, 5, 0}, Outline{{0, inf}, 5, 5, 0}, Outline{{0, 0}, 0, 5, 0},
        Outline{{0, 0}, 5, -1, 0}, Outline{{0, 0}, inf, 5, 0}, Outline{{0, 0}, 5, 5, nan}}) {
    EXPECT_FALSE(check_ellipse(wrong));
    EXPECT_FALSE(sight_from_outline(wrong, lens(1000)));
  }
  EXPECT_FALSE(sight_from_outline({{700, 700}, 1e-300, 1e-300, 0}, lens(1000)));
}

TEST(Outline, LiesWithItsCentreInThePicture) {
  EXPECT_TRUE(check_outline({{-0.5, 99.5}, 300, 300, 0}, 200, 100));
  EXPECT_FALSE(check_outline({{-0.6, 50}, 300, 300, 0}, 200, 100));
  EXPECT_FALSE(check_outline({{100, 99.6}, 300, 300, 0}, 200, 100));
  const auto refused = check_outline({{std::nan(""), 0}, 3, 3, 0}, 200, 100);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("200x100"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::optics
