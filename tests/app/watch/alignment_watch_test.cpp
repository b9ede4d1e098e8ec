// SPDX-License-Identifier: Apache-2.0
#include "app/watch/alignment_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tests/proc/align/detect/painted_ball.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using align::kPaintedLimb;

align::DriftSubject subject(const optics::Outline& outline = kPaintedLimb) {
  optics::Rig rig;
  optics::RigCamera camera;
  camera.name = "a";
  camera.width = 400;
  camera.height = 320;
  camera.outline = outline;
  camera.distance = 12;
  rig.cameras.push_back(camera);
  const auto subject = align::drift_subject(rig, rig.cameras.front());
  EXPECT_TRUE(subject) << subject.error().message;
  return *subject;
}

/// The ball, moved to the right.
cv::Mat picture(double shift) {
  optics::Outline limb = kPaintedLimb;
  limb.centre.u += shift;
  return align::painted_ball(align::kPaintedSize, limb);
}

class AlignmentWatchTest : public testing::Test {
 protected:
  AlignmentWatch watch(const optics::Outline& outline = kPaintedLimb, std::uint32_t alignment = 1) {
    auto made = AlignmentWatch::make("a", subject(outline), {}, folder_.path(), alignment);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }

  /// The figures after some pictures at 10 per second.
  CameraWatchStatus after(int pictures, AlignmentWatch& watch, const cv::Mat& pixels) {
    CameraWatchStatus figures;
    for (int n = 0; n < pictures; ++n) {
      now_ += std::chrono::milliseconds(100);
      watch.observe(orbwatch::tests::picture_of_mat(pixels), now_, figures);
    }
    return figures;
  }
  CameraWatchStatus after_a_second(AlignmentWatch& watch, const cv::Mat& pixels) {
    return after(10, watch, pixels);
  }
  /// Longer than the zero takes to be learnt.
  CameraWatchStatus after_learning(AlignmentWatch& watch, const cv::Mat& pixels) {
    return after(40, watch, pixels);
  }

  orbwatch::tests::TemporaryFolder folder_;
  hal::TimePoint now_{std::chrono::hours(1)};
};

TEST_F(AlignmentWatchTest, SaysThatTheBallIsWhereItWas) {
  AlignmentWatch watch = this->watch();
  const CameraWatchStatus seen = after_learning(watch, picture(0));
  EXPECT_EQ(seen.alignment, AlignmentLevel::Good);
  EXPECT_LT(seen.drift_error, 0.05);
  EXPECT_LT(seen.drift_shift, 0.05);
}

TEST_F(AlignmentWatchTest, SaysThatItLearnsItsZeroAndKnowsNoDriftMeanwhile) {
  AlignmentWatch watch = this->watch();
  for (int n = 0; n < 28; ++n) {  // five pictures, and 2.4 s from the fifth on
    const CameraWatchStatus seen = after(1, watch, picture(0));
    ASSERT_EQ(seen.alignment, AlignmentLevel::Learning) << n;
    EXPECT_TRUE(std::isnan(seen.drift_error)) << n;
    EXPECT_TRUE(std::isnan(seen.drift_shift)) << n;
    EXPECT_TRUE(watch.drift().is_learning);
  }
  EXPECT_EQ(after(2, watch, picture(0)).alignment, AlignmentLevel::Good);
  EXPECT_FALSE(watch.drift().is_learning);
}

TEST_F(AlignmentWatchTest, AJumpEndsTheLearning) {
  AlignmentWatch watch = this->watch();
  after_a_second(watch, picture(0));
  const CameraWatchStatus seen = after_a_second(watch, picture(5));
  EXPECT_EQ(seen.alignment, AlignmentLevel::Alarm);
  EXPECT_NEAR(seen.drift_shift, 4.3, 0.4) << "5 of 115 px";
}

TEST_F(AlignmentWatchTest, RaisesAnAlarmWhenItMoved) {
  AlignmentWatch watch = this->watch();
  after_learning(watch, picture(0));
  const CameraWatchStatus seen = after_a_second(watch, picture(2.3));
  EXPECT_EQ(seen.alignment, AlignmentLevel::Alarm);
  EXPECT_NEAR(seen.drift_shift, 2, 0.2) << "2.3 of 115 px";
  EXPECT_GT(seen.drift_error, 1);
}

TEST_F(AlignmentWatchTest, KnowsAfterARestartWhereTheBallWas) {
  {
    AlignmentWatch watch = this->watch();
    after_learning(watch, picture(0));
  }
  ASSERT_EQ(folder_.files(), 1);
  AlignmentWatch watch = this->watch();
  EXPECT_EQ(after_a_second(watch, picture(2.3)).alignment, AlignmentLevel::Alarm);
}

TEST_F(AlignmentWatchTest, TheZeroOfARestartIsTheMeanThatWasLearnt) {
  {
    AlignmentWatch watch = this->watch();
    after(5, watch, picture(0.6));
    after_learning(watch, picture(0));
  }
  AlignmentWatch watch = this->watch();
  const CameraWatchStatus seen = after_a_second(watch, picture(0));
  EXPECT_EQ(seen.alignment, AlignmentLevel::Good);
  EXPECT_LT(seen.drift_shift, 0.1) << "the picture that is kept is 0.5 % aside";
}

/// The ball stood for a second, then jumped; the appliance was switched off before it was put back.
TEST_F(AlignmentWatchTest, AJumpDuringTheLearningIsKnownAfterARestart) {
  {
    AlignmentWatch watch = this->watch();
    after_a_second(watch, picture(0));
    after(1, watch, picture(5));
  }
  AlignmentWatch watch = this->watch();
  EXPECT_EQ(after(1, watch, picture(5)).alignment, AlignmentLevel::Alarm);
  EXPECT_EQ(after_a_second(watch, picture(0)).alignment, AlignmentLevel::Good);
}

TEST_F(AlignmentWatchTest, LearnsANewZeroForAnotherAlignment) {
  {
    AlignmentWatch watch = this->watch();
    after_learning(watch, picture(0));
  }
  optics::Outline moved = kPaintedLimb;
  moved.centre.u += 2.3;
  AlignmentWatch watch = this->watch(moved, 2);
  EXPECT_EQ(after_a_second(watch, picture(2.3)).alignment, AlignmentLevel::Learning);
  EXPECT_EQ(after_learning(watch, picture(2.3)).alignment, AlignmentLevel::Good);
  EXPECT_EQ(folder_.files(), 1) << "it replaces the earlier one";
}

TEST_F(AlignmentWatchTest, DoesNotMeasureInTheDark) {
  AlignmentWatch watch = this->watch();
  after_learning(watch, picture(0));
  const CameraWatchStatus seen = after_a_second(watch, cv::Mat(320, 400, CV_8U, cv::Scalar(0)));
  EXPECT_EQ(seen.alignment, AlignmentLevel::NotVisible);
  EXPECT_TRUE(std::isnan(seen.drift_error));
}

TEST_F(AlignmentWatchTest, LearnsAnewWithADamagedFileAndSaysWhy) {
  {
    AlignmentWatch watch = this->watch();
    after_learning(watch, picture(0));
  }
  std::ofstream(zero_file(folder_.path(), "a")) << "no zero";
  AlignmentWatch watch = this->watch();
  testing::internal::CaptureStderr();
  EXPECT_EQ(after_a_second(watch, picture(0)).alignment, AlignmentLevel::Learning);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("drift-zero-a: is too short"), std::string::npos) << said;
  EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
  EXPECT_EQ(after_learning(watch, picture(0)).alignment, AlignmentLevel::Good);
  AlignmentWatch again = this->watch();
  EXPECT_EQ(after(1, again, picture(0)).alignment, AlignmentLevel::Good) << "it was replaced";
}

}  // namespace
}  // namespace orbwatch::app
