// SPDX-License-Identifier: Apache-2.0
#include "tests/proc/align/condition/soiled_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/support/mirror_room.h"

namespace orbwatch::tests {
namespace {

constexpr int kSide = 440;
constexpr double kJudged = 0.93;  // share of the radius

MirrorRoomSettings settings_of(std::uint64_t seed, double radius, double blur) {
  MirrorRoomSettings s;
  s.seed = seed;
  s.width = s.height = kSide;
  s.radius = radius;
  s.blur = blur;
  s.noise = 0;
  return s;
}

cv::Mat linear(const cv::Mat& bgr) {
  cv::Mat grey, light;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(light, CV_32F, 1 / 255.0);
  cv::pow(light, 2.2, light);
  return light;
}

}  // namespace

SoiledBall::SoiledBall(std::uint64_t seed) : random_(seed), size_(kSide, kSide) {
  const MirrorRoomPicture room = mirror_room(settings_of(seed, in(150, 205), in(0.4, 1.2)));
  limb_ = {room.limb.centre, room.limb.rx, room.limb.ry, 0};
  room_ = linear(room.pixels);
  lamps_ = room_ > 0.9;
  cv::dilate(lamps_, lamps_, cv::Mat::ones(5, 5, CV_8U));
  opacity_ = cv::Mat::zeros(size_, CV_32F);
  own_ = cv::Mat::zeros(size_, CV_32F);
  longitude_ = cv::Mat(size_, CV_32F, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  latitude_ = longitude_.clone();
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const double x = (u - limb_.centre.u) / limb_.rx, y = (v - limb_.centre.v) / limb_.ry;
      if (x * x + y * y >= 1) continue;
      // The ray (0, 0, -1), mirrored by the normal (x, y, z).
      const double z = std::sqrt(1 - x * x - y * y);
      longitude_.at<float>(v, u) = static_cast<float>(std::atan2(2 * z * x, 2 * z * z - 1));
      latitude_.at<float>(v, u) = static_cast<float>(std::asin(std::clamp(2 * z * y, -1.0, 1.0)));
    }
  }
  for (int i = 0; i < 4; ++i) things_.push_back(a_thing(0.15, 0.8));
}

SoiledBall::Thing SoiledBall::a_thing(double smallest, double largest) {
  return {in(-2.6, 2.6),         in(-1, 1),     in(smallest, largest),
          in(smallest, largest), in(0.02, 0.5), in(0, 1) < 0.5 ? in(0.05, 0.3) : 0};
}

void SoiledBall::show(const Thing& thing, cv::Mat& light) const {
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const double x = longitude_.at<float>(v, u) - thing.longitude;
      const double y = latitude_.at<float>(v, u) - thing.latitude;
      // Borders are a hundredth of a radian wide; NaN beside the ball shows nothing.
      const double inside =
          std::min(thing.width / 2 - std::abs(x), thing.height / 2 - std::abs(y)) / 0.01 + 0.5;
      if (!(inside > 0)) continue;
      const double stripe = thing.stripes > 0 ? 0.8 + 0.2 * std::sin(6.28 * x / thing.stripes) : 1;
      float& pixel = light.at<float>(v, u);
      pixel = static_cast<float>(
          std::lerp(static_cast<double>(pixel), thing.light * stripe, std::min(inside, 1.0)));
    }
  }
}

void SoiledBall::rearrange() {
  for (Thing& thing : things_) thing = a_thing(0.15, 0.8);
}

void SoiledBall::add_spot() {
  const double radius = in(0.012, 0.05) * limb_.rx, rho = 0.9 * std::sqrt(in(0, 1));
  const double angle = in(0, 2 * std::numbers::pi), opacity = in(0.5, 1), own = in(0, 0.05);
  const cv::Point2d middle(limb_.centre.u + rho * limb_.rx * std::cos(angle),
                           limb_.centre.v + rho * limb_.ry * std::sin(angle));
  const int reach = cvCeil(radius) + 3;
  const cv::Rect box(cvRound(middle.x) - reach, cvRound(middle.y) - reach, 2 * reach + 1,
                     2 * reach + 1);
  for (int v = box.y; v < box.y + box.height; ++v) {
    for (int u = box.x; u < box.x + box.width; ++u) {
      const double depth = (radius - std::hypot(u - middle.x, v - middle.y)) / 1.5 + 0.5;
      const auto here = static_cast<float>(opacity * std::clamp(depth, 0.0, 1.0));
      if (here <= opacity_.at<float>(v, u)) continue;
      opacity_.at<float>(v, u) = here;
      own_.at<float>(v, u) = static_cast<float>(own);
    }
  }
  largest_ = std::max(largest_, 2 * radius / limb_.rx);
}

void SoiledBall::add_scratch() {
  const double rho = 0.8 * std::sqrt(in(0, 1)), angle = in(0, 2 * std::numbers::pi);
  const double way = in(0, 2 * std::numbers::pi), length = in(0.05, 0.25) * limb_.rx;
  const cv::Point2d from(limb_.centre.u + rho * limb_.rx * std::cos(angle),
                         limb_.centre.v + rho * limb_.ry * std::sin(angle));
  const cv::Point2d to = from + cv::Point2d(length * std::cos(way), length * std::sin(way));
  if (std::hypot(to.x - limb_.centre.u, to.y - limb_.centre.v) > 0.9 * limb_.rx) return;
  cv::Mat line = cv::Mat::zeros(size_, CV_8U);
  cv::line(line, from, to, cv::Scalar(255), 2);
  own_.setTo(in(0.3, 0.6), line);
  opacity_.setTo(in(0.5, 0.9), line);
}

void SoiledBall::soil(double share) {
  while (soiled() < share) {
    if (in(0, 1) < 0.9) {
      add_spot();
    } else {
      add_scratch();
    }
  }
}

double SoiledBall::soiled() const {
  const double r = kJudged * limb_.rx;
  return cv::countNonZero(opacity_ >= 0.35) / (std::numbers::pi * r * r);
}

void SoiledBall::add_sparks(cv::Mat& light) {
  for (int i = static_cast<int>(in(0, 40)); i > 0; --i) {
    const cv::Point2d from(in(0, kSide), in(0, kSide));
    const cv::Point2d to = from + cv::Point2d(in(-8, 8), in(-8, 8));
    cv::line(light, from, to, cv::Scalar(in(0.5, 2)), 1);
  }
}

/// Lights one side more; lamps may be off; the exposure varies at random.
void SoiledBall::light_up(cv::Mat& light) {
  const bool lamps_off = in(0, 1) < 0.3;
  if (lamps_off) light.setTo(0.05, lamps_);
  const double exposure = std::exp2(in(-1.2, 1.2)), lean = in(-0.5, 0.5);
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      light.at<float>(v, u) *=
          static_cast<float>(exposure * (1 + lean * (u - kSide / 2.0) / (kSide / 2.0)));
    }
  }
}

cv::Mat SoiledBall::picture() {
  cv::Mat light = room_.clone();
  for (const Thing& thing : things_) show(thing, light);
  show(a_thing(0.05, 0.4), light);  // the tool
  add_sparks(light);
  if (fog_ > 0) light = light * (1 - fog_) + cv::mean(light)[0] * fog_;
  light = light.mul(1 - opacity_) + own_.mul(opacity_) * (2.5 * cv::mean(light)[0]);
  light_up(light);
  cv::GaussianBlur(light, light, {}, 0.7);
  cv::Mat noise(size_, CV_32F), grey;
  cv::RNG random(random_());
  random.fill(noise, cv::RNG::NORMAL, 0, in(0.5, 2.5));
  cv::pow(cv::min(light, 1), 1 / 2.2, grey);
  grey = grey * 255 + noise;
  grey.convertTo(grey, CV_8U);
  return grey;
}

}  // namespace orbwatch::tests
