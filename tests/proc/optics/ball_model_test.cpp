// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/ball_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>

#include "proc/optics/vec.h"
#include "tests/proc/reference_optics.h"

namespace orbwatch::optics {
namespace {

using Kind = BallModel::Kind;
using tests::kInfinity;

double alpha_of(double distance) { return 360 - 2 * degrees(std::asin(1 / distance)); }

CosSin angle(long double phi) {
  return {static_cast<double>(std::cos(phi)), static_cast<double>(std::sin(phi))};
}

double radians_of(const CosSin& angle) { return std::atan2(angle.sin, angle.cos); }

std::optional<double> rho(const BallModel& model, const CosSin& phi, double closeness = 0) {
  const auto stretch = model.stretch(phi.cos, phi.sin * phi.sin, closeness);
  if (!stretch) return std::nullopt;
  return stretch->along == 0 ? 1 : phi.sin * stretch->across / stretch->along;
}

// The law of reflection in terms of the incidence i, which needs no solver: phi = 2i - asin(q sin
// i) - asin(p sin i), psi = asin(q sin i).
TEST(BallModel, ExactSolvesReflectionAtEveryDistance) {
  constexpr int kIncidences = 200;
  double worst = 0, worst_close = 0;
  for (const double d : {1.0001, 1.01, 1.3, 1.5, 2.0, 3.0, 8.0, 12.0, 24.0, 100.0, 1e4}) {
    const BallModel model = BallModel::at_distance(Kind::Exact, d);
    const long double q = 1 / static_cast<long double>(d), limb = q / std::sqrt((1 - q) * (1 + q));
    for (const double p : {0.0, 1e-9, 1 / 40., 0.1, 1 / 3., 1 / 1.5, 0.9, 0.9999, 1.0}) {
      for (int k = 0; k <= kIncidences; ++k) {
        const long double i = std::numbers::pi_v<long double> / 2 * k / kIncidences;
        const long double psi = std::asin(q * std::sin(i));
        const auto measured = rho(model, angle(2 * i - psi - std::asin(p * std::sin(i))), p);
        ASSERT_TRUE(measured) << "d " << d << " p " << p << " k " << k;
        const double error =
            degrees(static_cast<double>(std::abs(std::atan(*measured * limb) - psi)));
        (d < 1.3 ? worst_close : worst) = std::max(d < 1.3 ? worst_close : worst, error);
      }
    }
  }
  std::cout << "worst camera ray: " << worst << " degrees, " << worst_close << " below d = 1.3\n";
  EXPECT_LT(worst, 1e-10);
  EXPECT_LT(worst_close, 1e-8);
}

TEST(BallModel, ExactEqualsTracedReflection) {
  for (const double distance : {1.3, 2.0, 3.0, 6.0, 10.0, 20.0, 100.0}) {
    const double alpha = alpha_of(distance);
    const BallModel model = BallModel::make(BallModel::Kind::Exact, alpha).value();
    for (int i = 0; i < 500; ++i) {
      const double phi = model.limit() * i / 500;
      // The tolerance is one ten-thousandth of a pixel on a ball of 1500 px radius.
      EXPECT_NEAR(rho(model, angle(phi)).value(), tests::reference_exact_rho(phi, alpha), 7e-8)
          << "distance " << distance << " phi " << degrees(phi);
    }
    EXPECT_NEAR(rho(model, angle(model.limit())).value(), 1, 1e-12);
  }
}

TEST(BallModel, PhiIsTheInverseOfRho) {
  const std::array models{BallModel::make(BallModel::Kind::Exact, alpha_of(1.05)).value(),
                          BallModel::make(BallModel::Kind::Exact, alpha_of(12)).value(),
                          BallModel::make(BallModel::Kind::Exact, 360).value(),
                          BallModel::make(BallModel::Kind::Paper, 346).value(),
                          BallModel::make(BallModel::Kind::Classical).value()};
  for (const BallModel& model : models) {
    for (int i = 0; i <= 1000; ++i) {
      const double place = i / 1000.0;
      const CosSin phi = model.phi(place).value();
      EXPECT_NEAR(std::hypot(phi.cos, phi.sin), 1, 1e-14);
      EXPECT_NEAR(rho(model, phi).value(), place, 1e-12) << "rho " << place;
    }
    EXPECT_NEAR(radians_of(model.phi(1).value()), model.limit(), 1e-12);
  }
}

// phi = incidence + theta, and theta = acos(1/d) where the ray grazes the ball.
TEST(BallModel, ThetaIsWhereTheRayLeavesTheBall) {
  for (const double d : {1.05, 2.0, 12.0, kInfinity}) {
    const BallModel model = BallModel::at_distance(Kind::Exact, d);
    for (double rho = 0; rho <= 1; rho += 0.01) {
      const double theta = radians_of(model.theta(rho));
      const double psi = d == kInfinity ? 0 : std::atan(rho / std::sqrt(d * d - 1));
      EXPECT_NEAR(radians_of(model.phi(rho).value()), 2 * theta + psi, 1e-14);
    }
    EXPECT_NEAR(radians_of(model.theta(1)), std::acos(1 / d), 1e-12);
  }
}

TEST(BallModel, ExactTendsToClassicalFarAway) {
  const BallModel far = BallModel::make(BallModel::Kind::Exact, alpha_of(1e7)).value();
  const BallModel orthographic = BallModel::make(BallModel::Kind::Exact, 360).value();
  for (double phi = 0; phi < 3.1; phi += 0.01) {
    const double classical =
        rho(BallModel::make(BallModel::Kind::Classical).value(), angle(phi)).value();
    EXPECT_NEAR(rho(far, angle(phi)).value(), classical, 1e-6);
    EXPECT_NEAR(rho(orthographic, angle(phi)).value(), classical, 1e-12);
  }
}

// Angles at which the cosine alone does not determine the angle.
TEST(BallModel, IsPreciseTowardsTheAxis) {
  for (const double away : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const CosSin ahead{std::cos(away), std::sin(away)}, behind{-std::cos(away), std::sin(away)};
    for (const BallModel& model : {BallModel::make(BallModel::Kind::Exact, 360).value(),
                                   BallModel::make(BallModel::Kind::Classical).value()}) {
      EXPECT_NEAR(rho(model, ahead).value() / std::sin(away / 2), 1, 1e-12);
      EXPECT_NEAR(rho(model, behind).value(), std::cos(away / 2), 1e-12);
    }
  }
}

TEST(BallModel, OnlyTheExactModelKnowsHowFarThingsAre) {
  const CosSin phi = angle(1.2);
  for (const BallModel& model : {BallModel::make(BallModel::Kind::Paper, 346).value(),
                                 BallModel::make(BallModel::Kind::Classical).value()}) {
    EXPECT_EQ(rho(model, phi, 0.3), rho(model, phi));
  }
  const BallModel exact = BallModel::make(BallModel::Kind::Exact, 346).value();
  EXPECT_GT(rho(exact, phi, 0.3).value(), rho(exact, phi).value() + 0.05);
}

// The published table of the other models' largest errors over the seen solid angle, far field.
TEST(BallModel, PaperAndClassicalMissByThePublishedErrors) {
  struct Row {
    double distance, classical, paper;
  };
  for (const Row& row : {Row{3, 18.1, 12.0}, {6, 9.4, 7.4}, {10, 5.70, 4.87}, {50, 1.15, 1.09}}) {
    const double alpha = alpha_of(row.distance);
    const BallModel exact = BallModel::make(BallModel::Kind::Exact, alpha).value();
    double classical = 0, paper = 0;
    for (int i = 0; i <= 2000; ++i) {
      const double rho = i / 2000.0;
      const auto error = [&](const BallModel& model) {
        return std::abs(radians_of(model.phi(rho).value()) - radians_of(exact.phi(rho).value()));
      };
      classical = std::max(classical, error(BallModel::make(BallModel::Kind::Classical).value()));
      paper = std::max(paper, error(BallModel::make(BallModel::Kind::Paper, alpha).value()));
    }
    // The classical model's largest error is on the limb, just outside of the table's range.
    EXPECT_NEAR(degrees(paper), row.paper, 0.06) << "distance " << row.distance;
    EXPECT_GE(degrees(classical), row.classical - 0.06) << "distance " << row.distance;
  }
}

TEST(BallModel, BlindConeIsUndefined) {
  const BallModel exact = BallModel::make(BallModel::Kind::Exact, 300).value();
  EXPECT_TRUE(rho(exact, angle(radians(149.999))));
  EXPECT_FALSE(rho(exact, angle(radians(150.001))));
  EXPECT_FALSE(exact.phi(1.0001));
  EXPECT_TRUE(rho(BallModel::make(BallModel::Kind::Classical).value(), angle(radians(180))));
}

// Near things are hidden earlier: a point on the ball's surface as soon as its surface turns away.
TEST(BallModel, BlindConeGrowsWithCloseness) {
  const double d = 12;
  const BallModel model = BallModel::at_distance(Kind::Exact, d);
  for (const double p : {0.0, 0.01, 0.3, 0.9, 0.9999}) {
    const double limit = std::acos(p) + std::acos(1 / d);
    EXPECT_NEAR(rho(model, angle(limit - 1e-9), p).value(), 1, 1e-9) << p;
    EXPECT_FALSE(rho(model, angle(limit + 1e-9), p)) << p;
  }
}

TEST(BallModel, NotANumberIsNotShown) {
  const double nan = std::nan("");
  for (const BallModel& model :
       {BallModel::at_distance(Kind::Exact, 12), BallModel::at_distance(Kind::Paper, 12)}) {
    EXPECT_FALSE(rho(model, {nan, 0.5}));
    EXPECT_FALSE(model.phi(nan));
    EXPECT_FALSE(model.phi(-0.1));
  }
  EXPECT_FALSE(rho(BallModel::at_distance(Kind::Exact, 12), {0, 1}, nan));
  EXPECT_FALSE(rho(BallModel::at_distance(Kind::Exact, 12), {1, 0}, 1.1));
}

TEST(BallModel, AlphaAndDistanceAreOneFact) {
  for (const double d : {1.0001, 1.3, 12.0, 1e3, 1e6}) {
    EXPECT_NEAR(BallModel::make(Kind::Exact, alpha_of(d))->distance() / d, 1, 1e-8);
  }
  EXPECT_NEAR(alpha_of(10), 348.52, 0.005);
  EXPECT_EQ(BallModel::make(Kind::Exact, 360)->distance(), kInfinity);
  EXPECT_EQ(alpha_of(kInfinity), 360);
  EXPECT_FALSE(BallModel::make(Kind::Exact, 180));
}

TEST(BallModel, TakesAlphaOrDistanceUnlessClassical) {
  for (const Kind kind : {Kind::Exact, Kind::Paper}) {
    EXPECT_EQ(BallModel::make(kind, 340, {})->kind(), kind);
    EXPECT_NEAR(BallModel::make(kind, {}, 12)->limit(), radians(alpha_of(12) / 2), 1e-12);
    EXPECT_FALSE(BallModel::make(kind, {}, {}));
    EXPECT_FALSE(BallModel::make(kind, 340, 12));
    EXPECT_FALSE(BallModel::make(kind, {}, 0.9));
  }
  EXPECT_TRUE(BallModel::make(Kind::Classical, {}, {}));
  EXPECT_FALSE(BallModel::make(Kind::Classical, 340, {}));
}

TEST(BallModel, RefusesWhatIsNoBall) {
  for (const double alpha : {180.0, 0.0, -20.0, 360.001, std::nan(""), 1e300}) {
    EXPECT_FALSE(BallModel::make(BallModel::Kind::Exact, alpha)) << alpha;
    EXPECT_FALSE(BallModel::make(BallModel::Kind::Paper, alpha)) << alpha;
  }
  EXPECT_NE(BallModel::make(BallModel::Kind::Exact, 170).error().message.find("(180, 360]"),
            std::string::npos);
  for (const double distance : {1.0, 0.0, -3.0, std::nan("")}) {
    EXPECT_FALSE(BallModel::make(BallModel::Kind::Exact, {}, distance)) << distance;
  }
}

}  // namespace
}  // namespace orbwatch::optics
