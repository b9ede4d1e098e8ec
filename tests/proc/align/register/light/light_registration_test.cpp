// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/light/light_registration.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "proc/align/rotation_fit.h"
#include "tests/proc/align/register/camera_pair.h"

namespace orbwatch::tests {
namespace {

using optics::degrees;
using optics::Vec3;

constexpr int kMoments = 20;

/// A place in the room, and its light.
struct Light {
  Vec3 direction;
  double closeness;
};

/// A melt pool that moves little, and sparks, at each moment.
std::vector<std::vector<Light>> process_light(std::mt19937_64& random) {
  std::normal_distribution<double> any;
  const Vec3 pool = normalized(Vec3{0.3, -0.6, -0.7});
  std::vector<std::vector<Light>> moments(kMoments);
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

/// What a camera sees of it.
std::vector<cv::Mat> seen_by(const optics::BallProjection& ball, int width, int height, int type,
                             const std::vector<std::vector<Light>>& moments) {
  std::vector<cv::Mat> pictures;
  for (const auto& lights : moments) {
    cv::Mat picture(height, width, type, cv::Scalar(40));
    for (const Light& light : lights) {
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

/// The rotations that explain the light of a process to the cameras of a pair.
Result<std::vector<align::Registration>> by_light(const CameraPair& pair,
                                                  const std::vector<std::vector<Light>>& moments) {
  const auto known = optics::ball_projection(pair.rig, pair.known).value();
  const align::SoughtCamera sought = pair.unknown();
  const auto ball = align::turned(sought, pair.truth, *pair.sought.outline).value();
  const auto a = seen_by(known, pair.known.width, pair.known.height, CV_8U, moments);
  const auto b = seen_by(ball, pair.sought.width, pair.sought.height, CV_16U, moments);
  return align::register_by_light({pictures_of_mats(a), pictures_of_mats(b)}, known, sought);
}

TEST(LightRegistration, FindsTheRotationBesideAPoolThatStaysInItsPlace) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    std::mt19937_64 random(seed);
    const CameraPair pair = camera_pair(seed, true);
    const auto found = by_light(pair, process_light(random));
    ASSERT_TRUE(found) << seed << ": " << found.error().message;
    EXPECT_LT(degrees(align::angle_between(found->front().rotation, pair.truth)), 5) << seed;
  }
}

TEST(LightRegistration, RefusesAPoolAlone) {
  std::mt19937_64 random(1);
  auto moments = process_light(random);
  for (auto& lights : moments) lights.resize(1);
  const auto found = by_light(camera_pair(1, true), moments);
  EXPECT_TRUE(!found || found->size() > 1) << "every turn about the pool explains it";
}

}  // namespace
}  // namespace orbwatch::tests
