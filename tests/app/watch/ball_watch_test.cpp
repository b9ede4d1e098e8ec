// SPDX-License-Identifier: Apache-2.0
#include "app/watch/ball_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "tests/proc/align/detect/painted_ball.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using align::kPaintedLimb;

cv::Mat sharp() {
  static const cv::Mat picture = align::painted_ball(align::kPaintedSize, kPaintedLimb);
  return picture.clone();
}

/// Dark boxes in a bright room.
cv::Mat boxes(double blur) {
  cv::Mat picture(320, 400, CV_8U, cv::Scalar(160));
  for (int n = 0; n < 9; ++n) {
    const cv::Point corner(140 + 45 * (n % 3), 100 + 45 * (n / 3));
    cv::rectangle(picture, {corner, cv::Size(24, 22)}, cv::Scalar(40), cv::FILLED);
  }
  cv::GaussianBlur(picture, picture, {}, blur);
  return picture;
}

/// Small dark spots on the ball.
cv::Mat soiled() {
  cv::Mat picture = sharp();
  for (int n = 0; n < 60; ++n) {
    const double angle = 2.4 * n, reach = 8.5 * std::sqrt(n);
    const cv::Point place(cvRound(kPaintedLimb.centre.u + reach * std::cos(angle)),
                          cvRound(kPaintedLimb.centre.v + reach * std::sin(angle)));
    cv::circle(picture, place, 3, cv::Scalar(5), cv::FILLED);
  }
  return picture;
}

class BallWatchTest : public testing::Test {
 protected:
  BallWatch watch(const WatchSettings& settings = {}) {
    auto made = BallWatch::make("a", 400, 320, kPaintedLimb, settings, folder_.path());
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
  /// The figures after more than a window of a picture.
  CameraWatchStatus after_hours(BallWatch& watch, const cv::Mat& pixels) {
    CameraWatchStatus figures;
    for (int n = 0; n < 11; ++n) {
      now_ += std::chrono::seconds(200);
      watch.observe(orbwatch::tests::picture_of_mat(pixels), now_, figures);
    }
    return figures;
  }
  CameraWatchStatus at_once(BallWatch& watch, const cv::Mat& pixels) {
    CameraWatchStatus figures;
    now_ += std::chrono::seconds(200);
    watch.observe(orbwatch::tests::picture_of_mat(pixels), now_, figures);
    return figures;
  }

  orbwatch::tests::TemporaryFolder folder_;
  hal::TimePoint now_{std::chrono::hours(1)};
};

TEST_F(BallWatchTest, MeasuresTheBlurAndJudgesItByItsLimits) {
  WatchSettings settings;
  settings.blur = {1.5, 2.5};
  BallWatch watch = this->watch(settings);
  EXPECT_EQ(at_once(watch, boxes(0.7)).focus, WatchLevel::Good);
  const CameraWatchStatus seen = at_once(watch, boxes(2));
  EXPECT_EQ(seen.focus, WatchLevel::Warning);
  EXPECT_NEAR(seen.blur, 2, 0.4);
  EXPECT_EQ(at_once(watch, boxes(3.5)).focus, WatchLevel::Alarm);
}

TEST_F(BallWatchTest, DoesNotMeasureInTheDark) {
  BallWatch watch = this->watch();
  const CameraWatchStatus seen = at_once(watch, cv::Mat(320, 400, CV_8U, cv::Scalar(0)));
  EXPECT_EQ(seen.focus, WatchLevel::NotMeasured);
  EXPECT_TRUE(std::isnan(seen.blur));
  EXPECT_EQ(seen.cleanliness, WatchLevel::NotMeasured);
}

TEST_F(BallWatchTest, LearnsTheCleanBallAndSeesItsDirt) {
  BallWatch watch = this->watch();
  EXPECT_EQ(at_once(watch, sharp()).cleanliness, WatchLevel::NotMeasured);
  const CameraWatchStatus clean = after_hours(watch, sharp());
  EXPECT_EQ(clean.cleanliness, WatchLevel::Good);
  EXPECT_LT(clean.contamination, 0.5);
  const CameraWatchStatus dirty = after_hours(watch, soiled());
  EXPECT_GT(dirty.contamination, 1);
}

TEST_F(BallWatchTest, KnowsTheCleanBallAfterARestart) {
  {
    BallWatch watch = this->watch();
    after_hours(watch, sharp());
  }
  ASSERT_EQ(folder_.files(), 1);
  BallWatch watch = this->watch();
  EXPECT_GT(after_hours(watch, soiled()).contamination, 1);
}

TEST_F(BallWatchTest, LearnsAnewWhenItIsTold) {
  BallWatch watch = this->watch();
  after_hours(watch, sharp());
  watch.learn_anew();
  EXPECT_EQ(folder_.files(), 0);
  const CameraWatchStatus seen = after_hours(watch, soiled());
  EXPECT_LT(seen.contamination, 0.5) << "these spots count as clean";
  EXPECT_EQ(folder_.files(), 1);
}

TEST_F(BallWatchTest, LearnsAnewWithoutAUsableFile) {
  {
    BallWatch watch = this->watch();
    after_hours(watch, sharp());
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    std::ofstream(entry.path()) << "no picture";
  }
  BallWatch watch = this->watch();
  EXPECT_EQ(after_hours(watch, sharp()).cleanliness, WatchLevel::Good);
}

}  // namespace
}  // namespace orbwatch::app
