// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/step_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace orbwatch::align {
namespace {

constexpr int kSide = 31;
const cv::Point kMiddle(15, 15);

cv::Mat picture_of(const std::function<double(double, double)>& light, double noise) {
  std::mt19937 random(3);
  std::normal_distribution<double> error;
  cv::Mat picture(kSide, kSide, CV_32F);
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      picture.at<float>(v, u) = static_cast<float>(light(u - 15, v - 15) + noise * error(random));
    }
  }
  return picture;
}

double step(double x, double sigma) { return 0.5 * std::erfc(-x / sigma / std::numbers::sqrt2); }

TEST(StepEdge, HasItsSigmaAtEveryAngleAndContrast) {
  for (const double sigma : {0.5, 1.0, 2.5}) {
    for (const double angle : {0.0, 0.3, 0.8, 2.2, -1.4}) {
      for (const double contrast : {20.0, 150.0}) {
        const double c = std::cos(angle), s = std::sin(angle);
        const cv::Mat picture = picture_of(
            [&](double u, double v) { return 40 + contrast * step(u * c + v * s - 0.4, sigma); },
            0.01 * contrast);
        const auto edge = fit_step_edge(picture, kMiddle, angle + 0.1, 0.01 * contrast);
        ASSERT_TRUE(edge) << sigma << ' ' << angle;
        EXPECT_NEAR(edge->sigma, sigma, 0.03 + 4 * edge->sigma_error);
        EXPECT_LT(edge->sigma_error, 0.2);
        // A part of a wide step may be fitted as a ramp.
        EXPECT_NEAR(edge->contrast, contrast, (sigma > 2 ? 0.3 : 0.05) * contrast);
      }
    }
  }
}

TEST(StepEdge, IsNotALineARampACornerOrNoise) {
  const auto refused = [](const std::function<double(double, double)>& light, double noise = 0.5) {
    return !fit_step_edge(picture_of(light, noise), kMiddle, 0, noise);
  };
  EXPECT_TRUE(refused([](double u, double) { return 100 * std::exp(-u * u / 2); }));
  EXPECT_TRUE(refused([](double u, double) { return 100 + 8 * u; }));
  EXPECT_TRUE(refused([](double u, double v) { return 100 * step(u, 0.7) * step(v, 0.7); }));
  EXPECT_TRUE(refused([](double u, double) { return 100 * step(u, 5); }));
  EXPECT_TRUE(refused([](double, double) { return 100; }, 0));
}

TEST(StepEdge, NeedsItsSurroundings) {
  const cv::Mat picture = picture_of([](double u, double) { return 100 * step(u, 1); }, 0);
  EXPECT_TRUE(fit_step_edge(picture, kMiddle, 0, 0));
  EXPECT_FALSE(fit_step_edge(picture, {15, kEdgeReach - 1}, 0, 0));
  EXPECT_FALSE(fit_step_edge(picture, {15, kSide - kEdgeReach}, 0, 0));
  EXPECT_FALSE(fit_step_edge(cv::Mat(5, 5, CV_32F, cv::Scalar(0)), {2, 2}, 0, 0));
}

}  // namespace
}  // namespace orbwatch::align
