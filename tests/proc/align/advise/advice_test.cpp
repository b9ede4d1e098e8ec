// SPDX-License-Identifier: Apache-2.0
#include "proc/align/advise/advice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/proc/reference_optics.h"

namespace orbwatch::align {
namespace {

const Arrangement kArrangement{.ball_diameter = 100,
                               .distance = 600,
                               .focal_length = 25,
                               .pixel = 3.45,
                               .sensor_width = 1920,
                               .sensor_height = 1080,
                               .target_distance = 400,
                               .smallest = std::nullopt};

Advice good(const Arrangement& arrangement) {
  const auto advice = advise(arrangement);
  EXPECT_TRUE(advice) << advice.error().message;
  return advice.value_or(Advice{});
}

/// The angle psi of the camera ray that shows a target in direction `phi` (radians), ball radii, by
/// tracing rays with plain vectors and bisection.
double traced_psi(double phi, double d, double target) {
  double low = 0, high = std::asin(1 / d);
  for (int i = 0; i < 60; ++i) {
    const double psi = (low + high) / 2;
    const optics::Vec3 ray{std::sin(psi), -std::cos(psi), 0}, camera{0, d, 0};
    const double b = dot(camera, ray);
    const optics::Vec3 hit = camera + ray * (-b - std::sqrt(std::max(0.0, b * b - d * d + 1)));
    const optics::Vec3 mirrored = ray - hit * (2 * dot(ray, hit));
    // Intersection with the sphere of the target's distance around the ball.
    const double along = dot(hit, mirrored);
    const optics::Vec3 there =
        hit + mirrored * (-along + std::sqrt(along * along - 1 + target * target));
    (std::atan2(there.x, there.y) < phi ? low : high) = psi;
  }
  return (low + high) / 2;
}

TEST(Advice, AgreesWithTracedRays) {
  std::mt19937 random(3);
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int n = 0; n < 50; ++n) {
    Arrangement s = kArrangement;
    s.ball_diameter = in(30, 150);
    s.distance = s.ball_diameter / 2 * in(4, 30);
    s.target_distance = s.ball_diameter / 2 * in(2, 40);
    s.focal_length = in(0.05, 0.3) * s.distance;
    const Advice a = good(s);
    const double radius = s.ball_diameter / 2, d = s.distance / radius;
    const double limb = std::asin(1 / d);
    EXPECT_NEAR(a.alpha, 360 - 2 * optics::degrees(limb), 1e-9);
    const double f = a.ball_pixels / std::tan(limb);  // px
    EXPECT_NEAR(f, s.focal_length / (s.pixel * 1e-3) / (1 - s.focal_length / a.focus), 1e-6 * f);
    ASSERT_FALSE(a.sights.empty());
    for (const TargetSight& sight : a.sights) {
      const double phi = optics::radians(sight.phi), step = 1e-4;
      const double target = s.target_distance / radius;
      // Resolution along the radius; across it the picture turns with the target.
      const double along = f *
                           (std::tan(traced_psi(phi + step, d, target)) -
                            std::tan(traced_psi(std::max(phi - step, 0.0), d, target))) /
                           (phi > 0 ? 2 * step : step) * optics::radians(1);
      const double across =
          phi > 0 ? f * std::tan(traced_psi(phi, d, target)) / std::sin(phi) * optics::radians(1)
                  : along;
      EXPECT_NEAR(sight.pixels_per_degree, std::min(along, across), 2e-3 * along) << sight.phi;
      EXPECT_NEAR(sight.pixels_per_mm * s.target_distance * optics::radians(1),
                  sight.pixels_per_degree, 1e-9);
      EXPECT_NEAR(sight.smallest * sight.pixels_per_mm, kMeasuredPixels, 1e-9);
      const double far = tests::traced_phi(traced_psi(phi, d, target), d);
      EXPECT_NEAR(sight.parallax, optics::degrees(std::abs(far - phi)), 1e-4) << sight.phi;
    }
  }
}

TEST(Advice, TheFNumberBlursBothEndsByAPixel) {
  const Advice a = good(kArrangement);
  // Thin lens: the image distance of each end, and the cone from the aperture to the sensor.
  const double radius = 50, before = 400 - radius;
  const double near = 600 - radius + 1 / (1 / before + 2 / radius),
               far = 600 - radius * radius / 600;
  EXPECT_NEAR(a.depth_of_field, far - near, 1e-9);
  const auto image = [](double s) { return 1 / (1 / 25.0 - 1 / s); };
  for (const double end : {near, far}) {
    const double blur = std::abs(image(end) - image(a.focus)) / image(end) * 25 / a.f_number;
    EXPECT_NEAR(blur, 3.45e-3, 1e-6);
  }
}

TEST(Advice, SaysWhatToChange) {
  EXPECT_NE(good(kArrangement).changes.at(0).find("a lens of"), std::string::npos);
  Arrangement s = kArrangement;
  s.focal_length *= 0.9 / good(s).fill;
  const Advice fitting = good(s);
  EXPECT_NEAR(fitting.fill, 0.9, 0.03);
  s.smallest = 1.01 * fitting.sights.back().smallest;
  for (const std::string& change : good(s).changes) {
    EXPECT_EQ(change.find("pixels across"), std::string::npos) << change;
  }
  s.smallest = fitting.sights.back().smallest / 4;
  const auto changes = good(s).changes;
  EXPECT_TRUE(std::ranges::any_of(changes, [](const std::string& change) {
    return change.find("4.0 times as many pixels") != std::string::npos;
  }));
  s.focal_length *= 1.3;
  EXPECT_NE(good(s).changes.at(0).find("larger than the picture"), std::string::npos);
}

TEST(Advice, RefusesWhatCannotBe) {
  const auto refused = [](auto change) {
    Arrangement s = kArrangement;
    change(s);
    const auto advice = advise(s);
    return advice ? std::string() : advice.error().message;
  };
  EXPECT_NE(refused([](Arrangement& s) { s.ball_diameter = 0; }).find("ball's diameter"),
            std::string::npos);
  EXPECT_NE(refused([](Arrangement& s) { s.pixel = -1; }).find("pixel"), std::string::npos);
  EXPECT_NE(refused([](Arrangement& s) { s.smallest = 0; }).find("smallest"), std::string::npos);
  EXPECT_NE(refused([](Arrangement& s) { s.distance = 49; }).find("inside of the ball"),
            std::string::npos);
  EXPECT_NE(refused([](Arrangement& s) { s.target_distance = 50; }).find("target"),
            std::string::npos);
  EXPECT_NE(refused([](Arrangement& s) { s.distance = 80; }).find("focuses"), std::string::npos);
  EXPECT_NE(refused([](Arrangement& s) { s.sensor_width = 0; }).find("sensor"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::align
