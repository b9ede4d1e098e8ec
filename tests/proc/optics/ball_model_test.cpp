#include "proc/optics/ball_model.h"

#include <gtest/gtest.h>

#include "proc/optics/angle.h"
#include "tests/proc/reference_optics.h"

namespace orbwatch::optics {
namespace {

double alpha_of(double distance) { return BallModel::alpha_from_distance(distance).value(); }

TEST(BallModel, ExactEqualsTracedReflection) {
  for (const double distance : {1.3, 2.0, 3.0, 6.0, 10.0, 20.0, 100.0}) {
    const double alpha = alpha_of(distance);
    const BallModel model = BallModel::exact(alpha).value();
    for (int i = 0; i < 500; ++i) {
      const double phi = model.limit() * i / 500;
      // One ten-thousandth of a pixel on a ball of 1500 px radius.
      EXPECT_NEAR(model.rho(phi), tests::reference_exact_rho(phi, alpha), 7e-8)
          << "distance " << distance << " phi " << degrees(phi);
    }
    EXPECT_NEAR(model.rho(model.limit()), 1, 1e-12);
  }
}

TEST(BallModel, PhiIsTheInverseOfRho) {
  const std::array models{BallModel::exact(alpha_of(1.05)).value(),
                          BallModel::exact(alpha_of(12)).value(), BallModel::exact(360).value(),
                          BallModel::paper(346).value(), BallModel::classical()};
  for (const BallModel& model : models) {
    for (int i = 0; i <= 1000; ++i) {
      const double rho = i / 1000.0;
      EXPECT_NEAR(model.rho(model.phi(rho)), rho, 1e-9) << "rho " << rho;
    }
    EXPECT_NEAR(model.phi(1), model.limit(), 1e-7);
  }
}

TEST(BallModel, ExactTendsToClassicalFarAway) {
  const BallModel far = BallModel::exact(alpha_of(1e7)).value();
  const BallModel orthographic = BallModel::exact(360).value();
  for (double phi = 0; phi < 3.1; phi += 0.01) {
    EXPECT_NEAR(far.rho(phi), BallModel::classical().rho(phi), 1e-6);
    EXPECT_NEAR(orthographic.rho(phi), BallModel::classical().rho(phi), 1e-12);
  }
}

// The published table of the other models' largest errors over the seen solid angle, far field.
TEST(BallModel, PaperAndClassicalMissByThePublishedErrors) {
  struct Row {
    double distance, classical, paper;
  };
  for (const Row& row : {Row{3, 18.1, 12.0}, {6, 9.4, 7.4}, {10, 5.70, 4.87}, {50, 1.15, 1.09}}) {
    const double alpha = alpha_of(row.distance);
    const BallModel exact = BallModel::exact(alpha).value();
    double classical = 0, paper = 0;
    for (int i = 0; i <= 2000; ++i) {
      const double rho = i / 2000.0, truth = exact.phi(rho);
      classical = std::max(classical, std::abs(BallModel::classical().phi(rho) - truth));
      paper = std::max(paper, std::abs(BallModel::paper(alpha)->phi(rho) - truth));
    }
    // The classical model is at its worst on the limb, just outside of what the table counts.
    EXPECT_NEAR(degrees(paper), row.paper, 0.06) << "distance " << row.distance;
    EXPECT_GE(degrees(classical), row.classical - 0.06) << "distance " << row.distance;
  }
}

TEST(BallModel, BlindConeIsUndefined) {
  const BallModel exact = BallModel::exact(300).value();
  EXPECT_FALSE(std::isnan(exact.rho(radians(149.999))));
  EXPECT_TRUE(std::isnan(exact.rho(radians(150.001))));
  EXPECT_TRUE(std::isnan(exact.phi(1.0001)));
  EXPECT_FALSE(std::isnan(BallModel::classical().rho(radians(180))));
}

TEST(BallModel, TakesAlphaOrDistanceUnlessClassical) {
  using Kind = BallModel::Kind;
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
    EXPECT_FALSE(BallModel::exact(alpha)) << alpha;
    EXPECT_FALSE(BallModel::paper(alpha)) << alpha;
  }
  EXPECT_NE(BallModel::exact(170).error().message.find("(180, 360]"), std::string::npos);
  for (const double distance : {1.0, 0.0, -3.0, std::nan("")}) {
    EXPECT_FALSE(BallModel::alpha_from_distance(distance)) << distance;
  }
}

}  // namespace
}  // namespace orbwatch::optics
