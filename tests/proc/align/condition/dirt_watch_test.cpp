// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/dirt_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "tests/proc/align/detect/painted_ball.h"
#include "tests/support/picture_of_mat.h"

namespace orbwatch::align {
namespace {

using optics::Outline;
using tests::picture_of_mat;

const Outline kWatchedLimb{{151.2, 148.9}, 120, 120, 0};
const cv::Size kWatchedSize(300, 300);

/// A ball that reflects a smooth room with large patches.
cv::Mat painted_room() {
  cv::Mat picture;
  cv::GaussianBlur(painted_ball(kWatchedSize, kWatchedLimb), picture, {}, 5);
  cv::rectangle(picture, {60, 110}, {120, 190}, cv::Scalar(170), cv::FILLED);
  cv::rectangle(picture, {180, 90}, {240, 150}, cv::Scalar(60), cv::FILLED);
  cv::GaussianBlur(picture, picture, {}, 0.7);
  return picture;
}

cv::Mat room() {
  static const cv::Mat picture = painted_room();
  return picture.clone();
}

using Change = std::function<void(cv::Mat&, int)>;

/// A watch that evaluates each picture, second by second.
class Watched {
 public:
  Watched()
      : watch_(DirtWatch::make(kWatchedSize.width, kWatchedSize.height, kWatchedLimb, {9, 0.15})
                   .value()) {}

  Watched& observe(int pictures, const Change& change = nullptr) {
    for (int n = 0; n < pictures; ++n) {
      cv::Mat picture = room(), noise(kWatchedSize, CV_16S);
      if (change) change(picture, n);
      random_.fill(noise, cv::RNG::NORMAL, 0, 1.5);
      picture.convertTo(picture, CV_16S);
      picture += noise;
      picture.convertTo(picture, CV_8U);
      watch_.observe(picture_of_mat(picture), now_);
      now_ += 1;
    }
    return *this;
  }
  Watched& learn() {
    observe(9);
    EXPECT_TRUE(watch_.use(watch_.learnt().value()));
    return *this;
  }
  std::string reason() const { return watch_.dirt() ? "measured" : watch_.dirt().error().message; }
  Dirt dirt() const { return watch_.dirt().value_or(Dirt{-1, -1, -1, -1}); }

  DirtWatch& watch() { return watch_; }

 private:
  DirtWatch watch_;
  double now_ = 100;
  cv::RNG random_{9};
};

void dot(cv::Mat& picture, const cv::Point& place, int radius, double light = 15) {
  cv::circle(picture, place, radius, cv::Scalar(light), cv::FILLED, cv::LINE_AA);
}

/// Five spots of spatter on 2 % of the ball.
void spatter(cv::Mat& picture, int) {
  for (const cv::Point place :
       {cv::Point(150, 150), {150, 200}, {100, 150}, {140, 90}, {200, 190}}) {
    dot(picture, place, 7);
  }
}
constexpr double kSpatter =
    5 * std::numbers::pi * 7 * 7 / (std::numbers::pi * 120 * 120) / (0.93 * 0.93);

TEST(DirtWatch, IsNotMeasuredBeforeItCan) {
  Watched watched;
  EXPECT_NE(watched.reason().find("no picture"), std::string::npos);
  EXPECT_FALSE(watched.watch().learnt());
  watched.observe(3);
  EXPECT_NE(watched.reason().find("3 of 5"), std::string::npos) << watched.reason();
  watched.observe(6);
  EXPECT_NE(watched.reason().find("clean ball"), std::string::npos) << watched.reason();
  EXPECT_TRUE(watched.learn().watch().dirt());
}

TEST(DirtWatch, IsNotMeasuredInTheDark) {
  Watched watched;
  watched.learn().observe(4, [](cv::Mat& picture, int) { picture.setTo(0); });
  EXPECT_EQ(watched.reason(), "measured") << "of pictures that still count";
  watched.observe(20, [](cv::Mat& picture, int) { picture.setTo(0); });
  EXPECT_NE(watched.reason().find("dark"), std::string::npos) << watched.reason();
  EXPECT_EQ(watched.observe(9).reason(), "measured");
}

TEST(DirtWatch, FindsSpatterInEveryLight) {
  Watched watched;
  EXPECT_EQ(watched.learn().observe(9).dirt().contamination, 0);
  for (const double exposure : {0.4, 1.2}) {
    watched.observe(9, [&](cv::Mat& picture, int n) {
      spatter(picture, n);
      picture *= exposure;
    });
    EXPECT_NEAR(watched.dirt().contamination, kSpatter, 0.35 * kSpatter) << exposure;
    EXPECT_NEAR(watched.dirt().largest_spot, 14 / 120.0, 0.03) << exposure;
    EXPECT_GT(watched.dirt().judged, 0.75);
  }
  EXPECT_EQ(watched.observe(9).dirt().contamination, 0) << "cleaned";
}

TEST(DirtWatch, FindsScratches) {
  Watched watched;
  watched.learn().observe(9, [](cv::Mat& picture, int) {
    cv::line(picture, {120, 200}, {180, 215}, cv::Scalar(230), 2, cv::LINE_AA);
  });
  EXPECT_GT(watched.dirt().contamination, 0.002);
  EXPECT_LT(watched.dirt().contamination, 0.01);
}

TEST(DirtWatch, LeavesOutWhatMovesOrIsLarge) {
  Watched watched;
  watched.learn().observe(18, [](cv::Mat& picture, int n) {
    dot(picture, {80 + 9 * n, 150}, 6);  // a tool, a spark
    dot(picture, {150, 80 + 8 * n}, 2, 255);
  });
  EXPECT_EQ(watched.dirt().contamination, 0);
  watched.observe(9, [](cv::Mat& picture, int) {
    cv::rectangle(picture, {120, 160}, {185, 210}, cv::Scalar(30), cv::FILLED);
  });
  EXPECT_EQ(watched.dirt().contamination, 0);
}

TEST(DirtWatch, LeavesOutWhatIsSqueezedAsReflectionsAre) {
  const auto arc = [](double rho, double wide) {
    return [=](cv::Mat& picture, int) {
      cv::ellipse(picture, {151, 149}, cv::Size(cvRound(rho * 120), cvRound(rho * 120)), 30, -wide,
                  wide, cv::Scalar(15), 3, cv::LINE_AA);
    };
  };
  Watched watched;
  EXPECT_EQ(watched.learn().observe(9, arc(0.88, 7)).dirt().contamination, 0);
  // Round things in the middle do not have the shape of such an arc.
  EXPECT_GT(watched.observe(9, arc(0.3, 20)).dirt().contamination, 0.002);
}

TEST(DirtWatch, KnowsEveryLightThatItHasLearnt) {
  const auto reflexes = [](cv::Mat& picture, int) { dot(picture, {150, 210}, 3, 210); };
  Watched dark, lit;
  dark.learn();
  lit.observe(9, reflexes);
  EXPECT_GT(dark.observe(9, reflexes).dirt().contamination, 0);
  const auto both = joined(dark.watch().learnt().value(), lit.watch().learnt().value());
  ASSERT_TRUE(dark.watch().use(both));
  EXPECT_EQ(dark.observe(9, reflexes).dirt().contamination, 0);
}

TEST(DirtWatch, SeesAFilm) {
  const auto texture = [](cv::Mat& picture) {
    for (int v = 40; v < 260; v += 12) {
      for (int u = 40; u < 260; u += 14) cv::circle(picture, {u, v}, 4, cv::Scalar(70), cv::FILLED);
    }
  };
  Watched watched;
  watched.observe(9, [&](cv::Mat& picture, int) { texture(picture); });
  ASSERT_TRUE(watched.watch().use(watched.watch().learnt().value()));
  EXPECT_EQ(watched.dirt().dulled, 0);
  watched.observe(9, [&](cv::Mat& picture, int) {
    texture(picture);
    picture.convertTo(picture, CV_8U, 0.4, 60);
  });
  EXPECT_GT(watched.dirt().dulled, 0.6);
  EXPECT_EQ(watched.dirt().contamination, 0);
}

TEST(DirtWatch, LooksNoOftenerThanItMust) {
  Watched watched;
  const cv::Mat picture = room();
  for (int n = 0; n < 40; ++n) watched.watch().observe(picture_of_mat(picture), n / 10.0);
  EXPECT_NE(watched.reason().find("4 of 5"), std::string::npos) << watched.reason();
}

TEST(DirtWatch, RefusesWhatIsWrong) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DirtWatch::make(300, 300, {{400, 150}, 100, 100, 0}));
  EXPECT_FALSE(DirtWatch::make(300, 300, {{150, 150}, none, 100, 0}));
  EXPECT_FALSE(DirtWatch::make(300, 300, kWatchedLimb, {0, 0.15}));
  EXPECT_FALSE(DirtWatch::make(300, 300, kWatchedLimb, {none, 0.15}));
  EXPECT_FALSE(DirtWatch::make(300, 300, kWatchedLimb, {900, 0.7}));
  EXPECT_FALSE(DirtWatch::make(300, 300, kWatchedLimb, {900, none}));
  Watched watched;
  EXPECT_FALSE(watched.watch().use({}));
  DirtReference forged = SmallMarks::none();
  forged.bright = cv::Mat::zeros(10, 10, CV_8U);
  EXPECT_FALSE(watched.watch().use(forged));
  forged.bright = cv::Mat::zeros(kRasterSide, kRasterSide, CV_16U);
  EXPECT_FALSE(watched.watch().use(forged));
  const cv::Mat small(200, 300, CV_8U, cv::Scalar(100));
  watched.watch().observe(picture_of_mat(small), 0);
  EXPECT_NE(watched.reason().find("300x200 instead of 300x300"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::align
