// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/view_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "proc/optics/ball_projection.h"

namespace orbwatch::align {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::Outline;
using optics::Vec3;

const Outline kDriftedLimb{{400, 300}, 250, 250, 0};

/// A direction at phi far away has rho = sin(phi/2): slopes along and across the shift are 2 /
/// cos(phi/2) and 2 cos(phi/2), and their mean over the sphere up to 150 degrees is an integral
/// with a closed form.
TEST(ViewError, IsWhatTheOrthographicBallGives) {
  const auto model = BallModel::make(BallModel::Kind::Exact, 360, std::nullopt);
  ASSERT_TRUE(model) << model.error().message;
  const auto projection = BallProjection::make(*model, kDriftedLimb, {});
  ASSERT_TRUE(projection) << projection.error().message;
  const double edge = std::pow(std::sin(optics::radians(75)), 2);
  const double radial = -4 * std::log(1 - edge) / edge, tangential = 4 * (1 - edge / 2);
  const double expected = 0.01 * std::sqrt((radial + tangential) / 2);
  const ViewError error(*projection, kDriftedLimb);
  EXPECT_NEAR(error.small({2.5, 0, 0, 0}), optics::degrees(expected), 0.03);
  EXPECT_NEAR(error.small({0, 2.5, 0, 0}), optics::degrees(expected), 0.03);
  EXPECT_NEAR(error.exact({0.25, 0, 0, 0}), optics::degrees(expected) / 10, 0.003);
}

TEST(ViewError, OfARollIsTheRollAcrossTheAxis) {
  const auto model = BallModel::make(BallModel::Kind::Exact, 360, std::nullopt);
  const auto projection = BallProjection::make(*model, kDriftedLimb, {});
  const ViewError error(*projection, kDriftedLimb);
  // A turn by a small angle moves a direction at phi by sin(phi): mean square over the cap.
  const double c = std::cos(optics::radians(150));
  const double mean = ((1 - c) - (1 - c * c * c) / 3) / (1 - c);
  EXPECT_NEAR(error.small({0, 0, 0, 0.01}), optics::degrees(0.01 * std::sqrt(mean)), 0.005);
  EXPECT_NEAR(error.exact({0, 0, 0, 0.01}), optics::degrees(0.01 * std::sqrt(mean)), 0.005);
}

TEST(ViewError, OfNothingIsNothing) {
  const auto model = BallModel::make(BallModel::Kind::Exact, std::nullopt, 5);
  const auto projection = BallProjection::make(*model, kDriftedLimb, {});
  const ViewError error(*projection, kDriftedLimb);
  EXPECT_EQ(error.small({}), 0);
  EXPECT_LT(error.exact({}), 1e-6);
}

TEST(PictureMotion, GoesAndComesBack) {
  const PictureMotion motion{3, -7, 0.02, -0.05};
  for (const optics::Vec2 pixel : {optics::Vec2{400, 300}, optics::Vec2{120, 450}}) {
    const auto there = after(motion, kDriftedLimb, pixel);
    const auto back = before(motion, kDriftedLimb, there);
    EXPECT_NEAR(back.u, pixel.u, 1e-9);
    EXPECT_NEAR(back.v, pixel.v, 1e-9);
  }
  const Outline limb = moved(kDriftedLimb, motion);
  const auto edge = after(motion, kDriftedLimb, {650, 300});
  EXPECT_NEAR(std::hypot(edge.u - limb.centre.u, edge.v - limb.centre.v), limb.rx, 1e-9);
}

}  // namespace
}  // namespace orbwatch::align
