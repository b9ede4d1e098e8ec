// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/light/light_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "proc/align/rotation_fit.h"
#include "tests/support/picture_of_mat.h"

namespace orbwatch::tests {
namespace {

using optics::degrees;
using optics::Vec3;

constexpr int kMoments = 20;
constexpr Vec3 kPool{0.3, -0.6, -0.7};  // a direction

/// A place in the room, and its light.
struct ProcessLight {
  Vec3 direction;
  double closeness;
};

/// A melt pool that moves little, and sparks, at each moment.
std::vector<std::vector<ProcessLight>> process_light(std::mt19937_64& random) {
  std::normal_distribution<double> any;
  const Vec3 pool = normalized(kPool);
  std::vector<std::vector<ProcessLight>> moments(kMoments);
  for (int m = 0; m < kMoments; ++m) {
    const double phase = 2 * M_PI * m / kMoments;
    moments[m].push_back(
        {normalized(pool + Vec3{std::cos(phase), std::sin(phase), 0} * 0.07), 0.1});
    for (int spark = 0; spark < 2; ++spark) {
      const Vec3 way{any(random), any(random), any(random)};
      moments[m].push_back({normalized(pool + way * 0.5), 0.08});
    }
  }
  return moments;
}

/// Pictures that a camera takes of the light.
std::vector<cv::Mat> seen_by(const optics::BallProjection& ball, int width, int height, int type,
                             const std::vector<std::vector<ProcessLight>>& moments) {
  std::vector<cv::Mat> pictures;
  for (const auto& lights : moments) {
    cv::Mat picture(height, width, type, cv::Scalar(40));
    for (const ProcessLight& light : lights) {
      const auto at = ball.pixel(light.direction, light.closeness);
      if (!at) continue;
      constexpr int kShift = 4;
      const cv::Point centre(static_cast<int>(std::lround(at->u * (1 << kShift))),
                             static_cast<int>(std::lround(at->v * (1 << kShift))));
      cv::circle(picture, centre, 2 << kShift, cv::Scalar(type == CV_8U ? 250 : 20'000), cv::FILLED,
                 cv::LINE_8, kShift);
    }
    pictures.push_back(picture);
  }
  return pictures;
}

/// Adds bright discs to each picture, all of them beside the ball and each time at other places.
void add_sparks_beside(const optics::Outline& limb, int count, std::vector<cv::Mat>& pictures) {
  std::mt19937_64 random(7);
  for (cv::Mat& picture : pictures) {
    std::uniform_int_distribution<int> column(0, picture.cols - 1), row(0, picture.rows - 1);
    const cv::Scalar bright(picture.depth() == CV_8U ? 255 : 60'000);
    for (int n = 0; n < count;) {
      const cv::Point centre(column(random), row(random));
      const optics::Vec2 pixel{static_cast<double>(centre.x), static_cast<double>(centre.y)};
      if (optics::relative_distance(limb, pixel) < 1.1) continue;
      cv::circle(picture, centre, 4, bright, cv::FILLED);
      ++n;
    }
  }
}

/// Ten radii away from the ball, which is in the middle of the picture.
optics::RigCamera camera_beside_the_ball(int width, int height, double radius) {
  optics::RigCamera camera;
  camera.name = "camera";
  camera.width = width;
  camera.height = height;
  camera.outline = optics::Outline{{width / 2.0, height / 2.0}, radius, radius, 0};
  camera.distance = 10;
  return camera;
}

/// The same by a lens behind a glass.
optics::RigCamera behind(const optics::Window& window, optics::RigCamera camera) {
  const double focal_length = camera.outline->rx * std::sqrt(99);
  camera.intrinsics = optics::Intrinsics{camera.width,
                                         camera.height,
                                         focal_length,
                                         focal_length,
                                         camera.outline->centre.u,
                                         camera.outline->centre.v,
                                         {},
                                         {}};
  camera.distance.reset();
  camera.window = window;
  return camera;
}

/// The rotations that explain the light of a process to a colour camera and to a thermal one, whose
/// registration is `truth`. `beside`: number of sparks that each sees directly, beside the ball.
/// `window`: a glass before the thermal camera.
Result<std::vector<align::Registration>> by_light(
    const optics::Mat3& truth, const std::vector<std::vector<ProcessLight>>& moments,
    int beside = 0, const std::optional<optics::Window>& window = {}) {
  const optics::Rig rig{{{}, 50}, {}, {}};
  const optics::RigCamera colour = camera_beside_the_ball(800, 600, 200);
  align::SoughtCamera thermal{{}, rig, camera_beside_the_ball(320, 256, 100), 0};
  if (window) thermal.camera = behind(*window, thermal.camera);
  const auto known = optics::ball_projection(rig, colour).value();
  const auto ball = align::turned(thermal, truth, *thermal.camera.outline).value();
  auto a = seen_by(known, 800, 600, CV_8U, moments);
  auto b = seen_by(ball, 320, 256, CV_16U, moments);
  add_sparks_beside(*colour.outline, beside, a);
  add_sparks_beside(*thermal.camera.outline, beside, b);
  return align::register_by_light({pictures_of_mats(a), pictures_of_mats(b)}, known, thermal);
}

TEST(LightRegistration, FindsTheRotationBesideAPoolThatStaysInItsPlace) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    std::mt19937_64 random(seed);
    const optics::Mat3 truth = align::rotation_about({0.3 * static_cast<double>(seed), -0.5, 0.2});
    const auto found = by_light(truth, process_light(random));
    ASSERT_TRUE(found) << seed << ": " << found.error().message;
    EXPECT_LT(degrees(align::angle_between(found->front().rotation, truth)), 5) << seed;
  }
}

TEST(LightRegistration, IgnoresBrighterSparksBesideTheBall) {
  std::mt19937_64 random(1);
  const optics::Mat3 truth = align::rotation_about({0.3, -0.5, 0.2});
  const auto found = by_light(truth, process_light(random), 15);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(degrees(align::angle_between(found->front().rotation, truth)), 5);
}

/// Before any turn the glass is edge-on.
TEST(LightRegistration, FindsTheRotationBehindASideWindow) {
  std::mt19937_64 random(1);
  const optics::Mat3 truth = align::rotation_about({0, 0, optics::radians(90)});
  const auto found = by_light(truth, process_light(random), 0, optics::Window{{1, 0, 0}, 10});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(degrees(align::angle_between(found->front().rotation, truth)), 5);
}

TEST(LightRegistration, IsNotSureByAPoolThatFlickersInOnePlace) {
  std::vector<std::vector<ProcessLight>> moments(40);
  for (std::size_t m = 0; m < moments.size(); m += 5) {
    for (const std::size_t lit : {m, m + 1}) moments[lit] = {{normalized(kPool), 0.1}};
  }
  const auto found = by_light(align::rotation_about({0.3, -0.5, 0.2}), moments);
  EXPECT_TRUE(!found || found->size() > 1) << "every turn about the pool explains it";
}

}  // namespace
}  // namespace orbwatch::tests
