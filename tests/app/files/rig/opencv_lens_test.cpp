// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>

#include "proc/optics/lens.h"
#include "proc/optics/vec.h"

/// Compares proc/optics/lens with the library whose models it implements.
namespace orbwatch::optics {
namespace {

const cv::Matx33d kCamera{1000, 0, 740, 0, 1100, 610, 0, 0, 1};

Intrinsics intrinsics(Distortion distortion, const std::array<double, 8>& coefficients) {
  return {1500, 1200, 1000, 1100, 740, 610, distortion, coefficients};
}

std::vector<cv::Vec3d> random_points(std::mt19937& random, double degrees_off) {
  std::uniform_real_distribution<double> off(0, radians(degrees_off)), around(0, 6.283),
      length(0.1, 1000);
  std::vector<cv::Vec3d> points;
  for (int i = 0; i < 200; ++i) {
    const double a = off(random), b = around(random), l = length(random);
    points.emplace_back(l * std::sin(a) * std::cos(b), l * std::sin(a) * std::sin(b),
                        l * std::cos(a));
  }
  return points;
}

void expect_pixels(const Lens& lens, const std::vector<cv::Vec3d>& points,
                   const std::vector<cv::Vec2d>& pixels, int least) {
  int shown = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = lens.pixel({points[i][0], points[i][1], points[i][2]});
    if (!pixel) continue;  // beyond the fold OpenCV continues
    ++shown;
    EXPECT_NEAR(pixel->u, pixels[i][0], 1e-9 * (1 + std::abs(pixels[i][0])));
    EXPECT_NEAR(pixel->v, pixels[i][1], 1e-9 * (1 + std::abs(pixels[i][1])));
  }
  EXPECT_GE(shown, least);
}

TEST(OpenCvLens, PinholeIsProjectPoints) {
  std::mt19937 random(1);
  for (const std::array<double, 8>& k :
       std::vector<std::array<double, 8>>{{},
                                          {-0.28, 0.09, 1e-3, -5e-4, -0.01, 0, 0, 0},
                                          {0.3, -0.1, 0, 2e-3, 0.05, 0, 0, 0},
                                          {12.1, 5.3, 1e-4, -2e-4, 0.21, 12.4, 9.8, 1.6}}) {
    const auto points = random_points(random, 40);
    std::vector<cv::Vec2d> pixels;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), kCamera, k, pixels);
    expect_pixels(Lens::make(intrinsics(Distortion::Pinhole, k)).value(), points, pixels, 200);
  }
}

TEST(OpenCvLens, FisheyeIsFisheyeProjectPoints) {
  std::mt19937 random(2);
  for (const cv::Vec4d& k :
       {cv::Vec4d(), cv::Vec4d(-0.02, 0.004, -0.002, 3e-4), cv::Vec4d(0.05, -0.01, 0.002, -1e-4)}) {
    // OpenCV's model covers the half in front of the camera.
    const auto points = random_points(random, 89);
    std::vector<cv::Vec2d> pixels;
    cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), kCamera, k);
    const Lens lens =
        Lens::make(intrinsics(Distortion::Fisheye, {k[0], k[1], k[2], k[3], 0, 0, 0, 0})).value();
    expect_pixels(lens, points, pixels, 200);
  }
}

TEST(OpenCvLens, DirectionIsUndistortPoints) {
  std::mt19937 random(3);
  const std::array<double, 8> k{-0.28, 0.09, 1e-3, -5e-4, -0.01, 0, 0, 0};
  const Lens lens = Lens::make(intrinsics(Distortion::Pinhole, k)).value();
  std::uniform_real_distribution<double> u(200, 1300), v(200, 1000);
  std::vector<cv::Vec2d> pixels, tangents;
  for (int i = 0; i < 200; ++i) pixels.emplace_back(u(random), v(random));
  cv::undistortPoints(
      pixels, tangents, kCamera, k, cv::noArray(), cv::noArray(),
      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Vec3 direction = lens.direction({pixels[i][0], pixels[i][1]}).value();
    EXPECT_NEAR(direction.x / direction.z, tangents[i][0], 1e-9);
    EXPECT_NEAR(direction.y / direction.z, tangents[i][1], 1e-9);
  }
}

}  // namespace
}  // namespace orbwatch::optics
