// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/drift_monitor.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/support/picture_of_mat.h"

/// Behaviour on pictures that are drawn with a known motion.
namespace orbwatch::align {
namespace {

using optics::Outline;
using tests::picture_of_mat;

const Outline kAlignedLimb{{160, 120}, 90, 90, 0};
constexpr int kWidth = 320, kHeight = 240;

/// A disc full of blots on a ground full of blots; each may move.
class DrawnBall {
 public:
  DrawnBall() : ball_(blots(1)), ground_(blots(2)) {
    mask_ = cv::Mat(2 * kHeight, 2 * kWidth, CV_32F, cv::Scalar(0));
    cv::circle(mask_, {2 * 160, 2 * 120}, 180, cv::Scalar(1), cv::FILLED, cv::LINE_AA);
  }

  /// A picture, 8 bit, with brightness times `gain`; its noise differs from picture to picture.
  cv::Mat at(cv::Point2d ball, cv::Point2d ground, double gain = 1) {
    const cv::Mat disc = shifted(mask_, ball);
    const cv::Mat seen =
        shifted(ball_, ball).mul(disc) + shifted(ground_, ground).mul(cv::Scalar(1) - disc);
    cv::Mat noise(seen.size(), CV_32F), out;
    rng_.fill(noise, cv::RNG::NORMAL, 0, 1.5);
    cv::Mat(seen * gain + noise).convertTo(out, CV_8U);
    return out;
  }

 private:
  static cv::Mat blots(int seed) {
    cv::Mat blots(kHeight / 4, kWidth / 4, CV_32F), wide;
    cv::RNG(static_cast<std::uint64_t>(seed)).fill(blots, cv::RNG::UNIFORM, 40, 160);
    cv::resize(blots, wide, {2 * kWidth, 2 * kHeight}, 0, 0, cv::INTER_CUBIC);
    return wide;
  }
  static cv::Mat shifted(const cv::Mat& fine, cv::Point2d way) {
    cv::Mat out;
    const cv::Matx23d map(2, 0, 0.5 - 2 * way.x, 0, 2, 0.5 - 2 * way.y);
    cv::warpAffine(fine, out, map, {kWidth, kHeight}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    return out;
  }

  cv::Mat ball_, ground_, mask_;
  cv::RNG rng_{7};
};

/// A blotched ball on ground without texture, with noise; 640x480, 8 bit.
class BallOnPlainGround {
 public:
  static constexpr int kRadius = 80;
  static constexpr Outline kLimb{{160, 240}, kRadius, kRadius, 0};

  BallOnPlainGround() : ball_(2 * kRadius + 1, 2 * kRadius + 1, CV_32F) {
    cv::Mat blots(20, 20, CV_32F);
    cv::RNG(4).fill(blots, cv::RNG::UNIFORM, 50, 150);
    cv::resize(blots, ball_, ball_.size(), 0, 0, cv::INTER_CUBIC);
    mask_ = cv::Mat(ball_.size(), CV_8U, cv::Scalar(0));
    cv::circle(mask_, {kRadius, kRadius}, kRadius, cv::Scalar(255), cv::FILLED);
  }

  static DriftSubject subject() {
    const auto model = optics::BallModel::make(optics::BallModel::Kind::Exact, std::nullopt, 12);
    return {640, 480, kLimb, *optics::BallProjection::make(*model, kLimb, {}), std::nullopt};
  }

  /// The ball at `right` px from its limb.
  cv::Mat at(int right) {
    cv::Mat seen = ground();
    const cv::Rect place(160 - kRadius + right, 240 - kRadius, ball_.cols, ball_.rows);
    ball_.copyTo(seen(place), mask_);
    return with_noise(seen);
  }
  cv::Mat without_ball() { return with_noise(ground()); }

 private:
  static cv::Mat ground() { return cv::Mat(480, 640, CV_32F, cv::Scalar(100)); }
  cv::Mat with_noise(const cv::Mat& seen) {
    cv::Mat noise(seen.size(), CV_32F), out;
    rng_.fill(noise, cv::RNG::NORMAL, 0, 1.5);
    cv::Mat(seen + noise).convertTo(out, CV_8U);
    return out;
  }

  cv::Mat ball_, mask_;
  cv::RNG rng_{11};
};

class DriftMonitorTest : public testing::Test {
 protected:
  static DriftSubject subject() {
    const auto model = optics::BallModel::make(optics::BallModel::Kind::Exact, std::nullopt, 12);
    return {kWidth, kHeight, kAlignedLimb, *optics::BallProjection::make(*model, kAlignedLimb, {}),
            std::nullopt};
  }

  DriftState see(const cv::Mat& pixels) {
    time_ += std::chrono::milliseconds(33);
    return monitor_.observe(picture_of_mat(pixels), time_).value();
  }
  DriftState see(int frames, cv::Point2d ball, cv::Point2d ground) {
    DriftState state;
    for (int n = 0; n < frames; ++n) state = see(drawn_.at(ball, ground));
    return state;
  }

  /// Number of frames that are measured, of a ball at rest.
  int measured_of(int frames, cv::Point2d way) {
    int measured = 0;
    DriftState before = see(1, way, way);
    for (int n = 0; n < frames; ++n) {
      const DriftState state = see(1, way, way);
      EXPECT_EQ(state.level, DriftLevel::Good);
      const bool is_another = state.motion.u != before.motion.u ||
                              state.motion.v != before.motion.v ||
                              state.motion.growth != before.motion.growth;
      measured += is_another ? 1 : 0;
      before = state;
    }
    return measured;
  }

  DrawnBall drawn_;
  DriftMonitor monitor_ = DriftMonitor::make(subject(), {0.3, 0.6}).value();
  DriftMonitor::Time time_{};
};

TEST_F(DriftMonitorTest, SaysGoodWhenNothingMoves) {
  EXPECT_EQ(see(4, {}, {}).level, DriftLevel::NotMeasured);
  for (int n = 0; n < 90; ++n) {
    const DriftState state = see(1, {}, {});
    ASSERT_EQ(state.level, DriftLevel::Good) << n << ": " << state.reason;
    EXPECT_LT(state.direction_error, 0.05);
  }
}

TEST_F(DriftMonitorTest, SaysThatItLearnsItsZeroUntilThatIsFixed) {
  for (int n = 0; n < 4; ++n) EXPECT_TRUE(see(1, {}, {}).is_learning) << "collects, " << n;
  for (int n = 0; n < 73; ++n) ASSERT_TRUE(see(1, {}, {}).is_learning) << "averages 2.4 s, " << n;
  EXPECT_FALSE(see(1, {}, {}).is_learning);
  const DriftState moved = see(90, {0.9, 0}, {0.9, 0});
  EXPECT_FALSE(moved.is_learning);
  EXPECT_NEAR(moved.motion.u, 0.9, 0.03);
}

TEST_F(DriftMonitorTest, DarknessIsNotLearning) {
  EXPECT_FALSE(see(drawn_.at({}, {}, 0)).is_learning);
  see(90, {}, {});
  EXPECT_FALSE(see(drawn_.at({}, {}, 0)).is_learning);
}

TEST_F(DriftMonitorTest, MeasuresATurnedCamera) {
  see(90, {}, {});
  const DriftState state = see(90, {1.3, -0.8}, {1.3, -0.8});
  EXPECT_NEAR(state.motion.u, 1.3, 0.03);
  EXPECT_NEAR(state.motion.v, -0.8, 0.03);
  EXPECT_EQ(state.level, DriftLevel::Alarm);
  EXPECT_EQ(state.cause, DriftCause::CameraTurned);
  EXPECT_NEAR(state.outline.centre.u, kAlignedLimb.centre.u + 1.3, 0.03);
  EXPECT_FALSE(state.turn) << "without a lens there are no angles";
}

TEST_F(DriftMonitorTest, TellsABallThatMoved) {
  see(90, {}, {});
  const DriftState state = see(90, {1.3, -0.8}, {});
  EXPECT_NEAR(state.motion.u, 1.3, 0.05);
  EXPECT_EQ(state.cause, DriftCause::BallMoved);
}

TEST_F(DriftMonitorTest, RaisesAJumpInItsOwnFrameAndMeasuresItThere) {
  see(40, {}, {});
  const DriftState state = see(1, {31.4, -12.2}, {31.4, -12.2});
  EXPECT_EQ(state.level, DriftLevel::Alarm);
  EXPECT_NEAR(state.motion.u, 31.4, 0.1);
  EXPECT_NEAR(state.motion.v, -12.2, 0.1);
  const DriftState back = see(1, {}, {});
  EXPECT_EQ(back.level, DriftLevel::Good) << "it is where it was";
}

TEST_F(DriftMonitorTest, MeasuresAStandingBallInOneOfThreeFrames) {
  see(120, {}, {});
  EXPECT_EQ(measured_of(60, {}), 20);
}

/// A drift that creeps to its limit is not found later than by every frame.
TEST_F(DriftMonitorTest, MeasuresABallFromHalfOfItsLimitOnInEachFrame) {
  see(120, {}, {});
  const cv::Point2d way(0.13, 0);  // 0.2 degrees, of 0.3
  EXPECT_EQ(see(90, way, way).level, DriftLevel::Good);
  EXPECT_EQ(measured_of(60, way), 60);
}

TEST_F(DriftMonitorTest, SeesEverythingInItsOwnFrameAtAnyMoment) {
  see(120, {}, {});
  for (int pause = 20; pause < 24; ++pause) {
    see(pause, {}, {});
    EXPECT_EQ(see(1, {-17, 9}, {-17, 9}).level, DriftLevel::Alarm) << pause;
    EXPECT_EQ(see(pause, {}, {}).level, DriftLevel::Good) << pause;
    EXPECT_EQ(see(drawn_.at({}, {}, 0.01)).level, DriftLevel::NotMeasured) << pause;
    EXPECT_EQ(see(1, {}, {}).level, DriftLevel::Good) << pause;
  }
}

TEST_F(DriftMonitorTest, RaisesADriftWithinASecondAtAnyMoment) {
  see(120, {}, {});
  for (int pause = 60; pause < 64; ++pause) {
    see(pause, {}, {});
    int frames = 1;
    const cv::Point2d way(0.3, 0);  // 0.5 degrees
    while (see(1, way, way).level < DriftLevel::Warning && frames < 40) ++frames;
    EXPECT_LE(frames, 30) << pause;
    see(60, {}, {});
  }
}

TEST_F(DriftMonitorTest, AJumpOfTheBallAlone) {
  see(40, {}, {});
  const DriftState state = see(1, {-17, 9}, {});
  EXPECT_EQ(state.level, DriftLevel::Alarm);
  EXPECT_NEAR(state.motion.u, -17, 0.2);
}

TEST_F(DriftMonitorTest, VibrationIsNoDrift) {
  std::mt19937 random(3);
  std::normal_distribution<double> jitter(0, 0.3);
  for (int n = 0; n < 200; ++n) {
    const cv::Point2d way(jitter(random), jitter(random));
    const DriftState state = see(drawn_.at(way, way));
    ASSERT_LT(static_cast<int>(state.level), static_cast<int>(DriftLevel::Warning)) << n;
  }
}

/// In the first frames after a restart the spread of the vibration is not known yet.
TEST_F(DriftMonitorTest, VibrationAfterARestartIsNoDrift) {
  const cv::Mat first = drawn_.at({}, {});
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> jitter(0, 0.3);
    monitor_ = DriftMonitor::make(subject(), {0.3, 0.6}).value();
    ASSERT_TRUE(monitor_.refer_to(picture_of_mat(first), DriftZero{{}, 0.02}));
    for (int n = 0; n < 12; ++n) {
      const cv::Point2d way(jitter(random), jitter(random));
      const DriftState state = see(drawn_.at(way, way));
      ASSERT_EQ(state.level, DriftLevel::Good) << seed << ", " << n << ": " << state.reason;
    }
  }
}

TEST_F(DriftMonitorTest, ADriftBeforeARestartIsRaisedWithinEightFrames) {
  ASSERT_TRUE(monitor_.refer_to(picture_of_mat(drawn_.at({}, {})), DriftZero{{}, 0.02}));
  EXPECT_EQ(see(8, {0.9, 0}, {0.9, 0}).level, DriftLevel::Alarm);
}

TEST_F(DriftMonitorTest, AJumpBeforeARestartIsRaisedInTheFirstFrame) {
  ASSERT_TRUE(monitor_.refer_to(picture_of_mat(drawn_.at({}, {})), DriftZero{{}, 0.02}));
  EXPECT_EQ(see(1, {9, -5}, {9, -5}).level, DriftLevel::Alarm);
}

TEST_F(DriftMonitorTest, LearnsHowSureItsZeroIsFromFewPicturesPerSecond) {
  std::mt19937 random(3);
  std::normal_distribution<double> jitter(0, 0.3);
  bool is_learning = true;
  for (int second = 0; second < 30 && is_learning; ++second) {
    const cv::Point2d way(jitter(random), jitter(random));
    const cv::Mat pixels = drawn_.at(way, way);
    const auto state = monitor_.observe(picture_of_mat(pixels), std::chrono::seconds(second));
    is_learning = state.value().is_learning;
  }
  EXPECT_FALSE(is_learning);
  EXPECT_GT(monitor_.zero().sigma, 0.02);
}

/// A plain wall is in the ball's former place, as flat as in the dark.
TEST_F(DriftMonitorTest, RaisesAJumpFarAwayFromAPlainWallInItsOwnFrame) {
  BallOnPlainGround drawn;
  monitor_ = DriftMonitor::make(BallOnPlainGround::subject(), {0.3, 0.6}).value();
  for (int n = 0; n < 90; ++n) see(drawn.at(0));
  ASSERT_EQ(see(drawn.at(0)).level, DriftLevel::Good);
  constexpr int kFar = 3 * BallOnPlainGround::kRadius;
  const DriftState state = see(drawn.at(kFar));
  EXPECT_EQ(state.level, DriftLevel::Alarm) << state.reason;
  EXPECT_NEAR(state.motion.u, kFar, 0.1);
  EXPECT_EQ(see(drawn.at(0)).level, DriftLevel::Good) << "it is where it was";
}

TEST_F(DriftMonitorTest, APlainWallInsteadOfTheBallIsNotDarkness) {
  BallOnPlainGround drawn;
  monitor_ = DriftMonitor::make(BallOnPlainGround::subject(), {0.3, 0.6}).value();
  for (int n = 0; n < 90; ++n) see(drawn.at(0));
  for (int n = 0; n < 40; ++n) {
    const DriftState state = see(drawn.without_ball());
    ASSERT_EQ(state.level, DriftLevel::NotMeasured) << n;
    ASSERT_NE(state.reason.find("elsewhere"), std::string_view::npos) << n << ": " << state.reason;
  }
}

TEST_F(DriftMonitorTest, ExposureIsNoDrift) {
  see(90, {}, {});
  for (const double gain : {0.4, 0.7, 1.4, 1.0}) {
    for (int n = 0; n < 20; ++n) {
      const DriftState state = see(drawn_.at({}, {}, gain));
      ASSERT_EQ(state.level, DriftLevel::Good) << gain << ": " << state.reason;
      EXPECT_LT(state.direction_error, 0.1);
    }
  }
}

TEST_F(DriftMonitorTest, SaysWhyItCannotMeasure) {
  see(40, {2, 0}, {2, 0});
  const auto reason = [&](const cv::Mat& pixels) {
    const DriftState state = see(pixels);
    EXPECT_EQ(state.level, DriftLevel::NotMeasured);
    return std::string(state.reason);
  };
  EXPECT_NE(reason(drawn_.at({}, {}, 0.01)).find("dark"), std::string::npos);
  EXPECT_NE(reason(drawn_.at({}, {}, 8)).find("overexposed"), std::string::npos);
  cv::Mat other(kHeight, kWidth, CV_8U);
  cv::RNG(9).fill(other, cv::RNG::UNIFORM, 0, 200);
  cv::GaussianBlur(other, other, {}, 2);
  cv::normalize(other, other, 20, 220, cv::NORM_MINMAX);
  EXPECT_NE(reason(other).find("reference"), std::string::npos);
  EXPECT_EQ(see(1, {2, 0}, {2, 0}).level, DriftLevel::Good) << "afterwards it goes on";
}

TEST_F(DriftMonitorTest, WaitsForATextureAtTheBeginning) {
  const cv::Mat wall(kHeight, kWidth, CV_8U, cv::Scalar(100));
  for (int n = 0; n < 12; ++n) EXPECT_EQ(see(wall).level, DriftLevel::NotMeasured);
  EXPECT_EQ(see(cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(1))).level, DriftLevel::NotMeasured);
  EXPECT_EQ(see(30, {}, {}).level, DriftLevel::NotMeasured) << "not at once, which is dear";
  EXPECT_EQ(see(120, {}, {}).level, DriftLevel::Good);
}

TEST_F(DriftMonitorTest, ComparesWithThePictureOfTheAlignment) {
  ASSERT_TRUE(monitor_.refer_to(picture_of_mat(drawn_.at({}, {}))));
  const DriftState state = see(30, {0.9, 0}, {0.9, 0});
  EXPECT_EQ(state.level, DriftLevel::Alarm);
  EXPECT_NEAR(state.motion.u, 0.9, 0.04);
}

TEST_F(DriftMonitorTest, MeasuresTheSameInEveryFormat) {
  cv::Mat bgr, sixteen;
  ASSERT_TRUE(monitor_.refer_to(picture_of_mat(drawn_.at({}, {}))));
  const cv::Mat moved = drawn_.at({1, 0}, {1, 0});
  cv::cvtColor(moved, bgr, cv::COLOR_GRAY2BGR);
  EXPECT_NEAR(see(bgr).motion.u, 1, 0.05);
  moved.convertTo(sixteen, CV_16U, 200, 3000);
  // Thermal counts have another gain and offset.
  auto thermal = DriftMonitor::make(subject(), {0.3, 0.6}).value();
  cv::Mat first;
  drawn_.at({}, {}).convertTo(first, CV_16U, 200, 2000);
  ASSERT_TRUE(thermal.refer_to(picture_of_mat(first)));
  EXPECT_NEAR(thermal.observe(picture_of_mat(sixteen), {}).value().motion.u, 1, 0.05);
}

TEST_F(DriftMonitorTest, RefusesWhatCannotBeWatched) {
  const auto refused = [](DriftSubject subject, DriftLimits limits) {
    const auto monitor = DriftMonitor::make(subject, limits);
    return monitor ? std::string() : monitor.error().message;
  };
  DriftSubject small = subject(), outside = subject();
  small.outline.rx = small.outline.ry = 20;
  outside.outline.centre.u = 500;
  EXPECT_NE(refused(small, {}).find("radius"), std::string::npos);
  EXPECT_FALSE(refused(outside, {}).empty());
  EXPECT_NE(refused(subject(), {0, 1}).find("limits"), std::string::npos);
  EXPECT_NE(refused(subject(), {0.5, 0.4}).find("limits"), std::string::npos);
  EXPECT_NE(refused(subject(), {0.5, NAN}).find("limits"), std::string::npos);
  const auto other = monitor_.observe(picture_of_mat(cv::Mat(100, 100, CV_8U)), {});
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("100x100"), std::string::npos);
  EXPECT_FALSE(monitor_.refer_to(picture_of_mat(cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(9)))));
}

}  // namespace
}  // namespace orbwatch::align
