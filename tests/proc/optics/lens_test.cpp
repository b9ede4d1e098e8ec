// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "proc/image/picture.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {
namespace {

Intrinsics intrinsics(Distortion distortion, std::array<double, 8> coefficients) {
  return {1500, 1200, 1000, 1100, 740, 610, distortion, coefficients};
}

Lens lens(Distortion distortion, std::array<double, 8> coefficients) {
  return Lens::make(intrinsics(distortion, coefficients)).value();
}

/// Distortions like those of real lenses' calibrations, from mild to strong.
Intrinsics random_calibration(std::mt19937& random, Distortion distortion) {
  const auto about = [&](double size) {
    return std::uniform_real_distribution<double>(-size, size)(random);
  };
  Intrinsics i = intrinsics(distortion, {});
  if (distortion == Distortion::Pinhole) {
    i.coefficients = {about(0.4), about(0.2), about(2e-3), about(2e-3), about(0.1)};
    if (random() % 2 == 0) {
      i.coefficients[5] = about(0.3);
      i.coefficients[6] = about(0.1);
      i.coefficients[7] = about(0.02);
    }
  } else if (distortion == Distortion::Fisheye) {
    i.coefficients = {about(0.1), about(0.03), about(0.01), about(0.003)};
  }
  return i;
}

Vec3 at(double degrees_off, double around) {
  const double a = radians(degrees_off);
  return {std::sin(a) * std::cos(around), std::sin(a) * std::sin(around), std::cos(a)};
}

TEST(Lens, WithoutDistortionIsAPinhole) {
  const Lens straight = lens(Distortion::None, {});
  const Vec2 pixel = straight.pixel({1, -2, 4}).value();
  EXPECT_DOUBLE_EQ(pixel.u, 740 + 1000 * 0.25);
  EXPECT_DOUBLE_EQ(pixel.v, 610 - 1100 * 0.5);
  EXPECT_LT(angle_between(straight.direction(pixel).value(), {1, -2, 4}), 1e-15);
}

TEST(Lens, PinholeShowsNothingBehindTheCamera) {
  for (const Lens& l : {lens(Distortion::None, {}), lens(Distortion::Pinhole, {0.1})}) {
    EXPECT_FALSE(l.pixel({0, 0, 0}));
    EXPECT_FALSE(l.pixel({0, 0, -1}));
    EXPECT_FALSE(l.pixel({1, 1, 0}));
    EXPECT_FALSE(l.pixel({0, 0, std::nan("")}));
    EXPECT_FALSE(l.direction({std::nan(""), 0}));
    EXPECT_FALSE(l.direction({0, std::numeric_limits<double>::infinity()}));
  }
}

TEST(Lens, FisheyeShowsAlmostAllAround) {
  const Lens fisheye = lens(Distortion::Fisheye, {});
  for (const double off : {0.0, 1e-9, 45.0, 90.0, 135.0, 179.9}) {
    const Vec2 pixel = fisheye.pixel(at(off, 0)).value();
    EXPECT_NEAR(pixel.u, 740 + 1000 * radians(off), 1e-9);
    EXPECT_NEAR(pixel.v, 610, 1e-9);
    EXPECT_LT(angle_between(fisheye.direction(pixel).value(), at(off, 0)), 1e-12);
  }
  EXPECT_FALSE(fisheye.pixel({0, 0, -1})) << "a circle of pixels, not one";
  EXPECT_FALSE(fisheye.pixel({0, 0, 0}));
  EXPECT_FALSE(fisheye.direction({740 + 1000 * 3.15, 610})) << "more than 180 degrees off";
}

TEST(Lens, DirectionIsTheInverseOfPixel) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(0, 89), around(-std::numbers::pi, std::numbers::pi);
  int shown = 0;
  for (int n = 0; n < 300; ++n) {
    const Distortion distortion = n % 2 == 0 ? Distortion::Pinhole : Distortion::Fisheye;
    const auto l = Lens::make(random_calibration(random, distortion));
    if (!l) continue;
    for (int i = 0; i < 20; ++i) {
      const double angle = off(random), turn = around(random);
      const auto pixel = l->pixel(at(angle, turn));
      // The inverse has no derivative at the fold: a small step inwards avoids that.
      if (!pixel || !l->pixel(at(angle * 1.01, turn))) continue;
      ++shown;
      const auto again = l->direction(*pixel);
      ASSERT_TRUE(again) << "calibration " << n << ", " << angle << " degrees off";
      EXPECT_LT(angle_between(*again, at(angle, turn)), 1e-11) << "calibration " << n;
      const Vec2 back = l->pixel(*again).value();
      EXPECT_NEAR(back.u, pixel->u, 1e-12 * (1000 + std::abs(pixel->u)));
      EXPECT_NEAR(back.v, pixel->v, 1e-12 * (1000 + std::abs(pixel->v)));
    }
  }
  EXPECT_GT(shown, 2000);
}

TEST(Lens, PixelOfAPixelsDirectionIsThatPixel) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(-0.5, 1499.5), v(-0.5, 1199.5);
  int shown = 0;
  for (int n = 0; n < 300; ++n) {
    const auto l = Lens::make(
        random_calibration(random, n % 2 == 0 ? Distortion::Pinhole : Distortion::Fisheye));
    if (!l) continue;
    for (int i = 0; i < 20; ++i) {
      const Vec2 pixel{u(random), v(random)};
      const auto direction = l->direction(pixel);
      if (!direction) continue;
      ++shown;
      EXPECT_NEAR(norm(*direction), 1, 1e-14);
      const auto again = l->pixel(*direction);
      ASSERT_TRUE(again);
      EXPECT_NEAR(again->u, pixel.u, 2e-9);
      EXPECT_NEAR(again->v, pixel.v, 2e-9);
    }
  }
  EXPECT_GT(shown, 4000) << "most pixels of most calibrations";
}

TEST(Lens, EndsWhereABarrelWouldFold) {
  // r - 0.3 r^3 increases up to r = 1 / sqrt(0.9), where it is 2/3 r.
  const Lens barrel = lens(Distortion::Pinhole, {-0.3});
  const double fold = 1 / std::sqrt(0.9), shown = fold * 2 / 3;
  EXPECT_TRUE(barrel.pixel({fold * (1 - 1e-9), 0, 1}));
  EXPECT_FALSE(barrel.pixel({fold * (1 + 1e-9), 0, 1}));
  EXPECT_TRUE(barrel.direction({740 + 1000 * shown * (1 - 1e-9), 610}));
  EXPECT_FALSE(barrel.direction({740 + 1000 * shown * (1 + 1e-9), 610}));
  EXPECT_FALSE(barrel.direction({740 + 1e6, 610}));
}

TEST(Lens, EndsWhereAFisheyeWouldFold) {
  // a - 0.05 a^3 increases up to a = 1 / sqrt(0.15).
  const Lens fisheye = lens(Distortion::Fisheye, {-0.05});
  const double fold = 1 / std::sqrt(0.15), shown = fold * 2 / 3;
  EXPECT_TRUE(fisheye.pixel(at(degrees(fold) - 1e-6, 1)));
  EXPECT_FALSE(fisheye.pixel(at(degrees(fold) + 1e-6, 1)));
  EXPECT_TRUE(fisheye.direction({740, 610 + 1100 * shown * (1 - 1e-9)}));
  EXPECT_FALSE(fisheye.direction({740, 610 + 1100 * shown * (1 + 1e-9)}));
}

TEST(Lens, EndsAtAPoleOfTheRationalModel) {
  // r / (1 - 0.5 r^2) grows without bound towards r = sqrt(2) and comes back from the other side.
  const Lens rational = lens(Distortion::Pinhole, {0, 0, 0, 0, 0, -0.5});
  EXPECT_TRUE(rational.pixel({1.4142, 0, 1}));
  EXPECT_FALSE(rational.pixel({1.4143, 0, 1}));
  EXPECT_FALSE(rational.pixel({2, 0, 1}));
}

TEST(Lens, NoTwoDirectionsShareAPixel) {
  // The test includes decentring far beyond real lenses, which makes the fold out of round: the
  // part shown keeps its orientation, (image(a) - image(b)) . (a - b) > 0.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> decentring(-0.1, 0.1), place(-1.5, 1.5), radial(-0.3, 0.3);
  int pairs = 0;
  for (int n = 0; n < 200; ++n) {
    const Lens l = lens(Distortion::Pinhole, {radial(random), radial(random), decentring(random),
                                              decentring(random), radial(random)});
    for (int i = 0; i < 200; ++i) {
      const Vec2 a{place(random), place(random)}, b{place(random), place(random)};
      const auto pixel_a = l.pixel({a.u, a.v, 1}), pixel_b = l.pixel({b.u, b.v, 1});
      if (!pixel_a || !pixel_b) continue;
      ++pairs;
      EXPECT_GT((pixel_a->u - pixel_b->u) / 1000 * (a.u - b.u) +
                    (pixel_a->v - pixel_b->v) / 1100 * (a.v - b.v),
                0);
    }
  }
  EXPECT_GT(pairs, 3000);
}

TEST(Lens, RefusesWhatIsNoCalibration) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const auto refused = [](auto change) {
    Intrinsics i = intrinsics(Distortion::Pinhole, {-0.1, 0.02});
    EXPECT_TRUE(Lens::make(i));
    change(i);
    const auto l = Lens::make(i);
    return !l && l.error().message.find('\n') == std::string::npos;
  };
  EXPECT_TRUE(refused([](Intrinsics& i) { i.width = 0; }));
  EXPECT_TRUE(refused([](Intrinsics& i) { i.height = kMaxSide + 1; }));
  EXPECT_TRUE(refused([](Intrinsics& i) { i.fx = 0; }));
  EXPECT_TRUE(refused([](Intrinsics& i) { i.fy = -3; }));
  EXPECT_TRUE(refused([&](Intrinsics& i) { i.fx = nan; }));
  EXPECT_TRUE(refused([&](Intrinsics& i) { i.fy = inf; }));
  EXPECT_TRUE(refused([&](Intrinsics& i) { i.cx = nan; }));
  EXPECT_TRUE(refused([&](Intrinsics& i) { i.cy = -inf; }));
  EXPECT_TRUE(refused([&](Intrinsics& i) { i.coefficients[7] = nan; }));
  EXPECT_TRUE(refused([](Intrinsics& i) { i.distortion = Distortion::None; }));
  EXPECT_TRUE(refused([](Intrinsics& i) {
    i.distortion = Distortion::Fisheye;
    i.coefficients[4] = 0.1;
  }));
  EXPECT_TRUE(refused([](Intrinsics& i) { i.coefficients[0] = -100; })) << "folds at 58 pixels";
  EXPECT_TRUE(refused([](Intrinsics& i) { i.coefficients[2] = 10; })) << "so does decentring";
}

}  // namespace
}  // namespace orbwatch::optics
