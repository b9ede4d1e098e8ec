// SPDX-License-Identifier: Apache-2.0
#include "tests/support/mirror_room.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

#include "app/simulation/scene/hash.h"
#include "tests/support/mirror_room_scene.h"

namespace orbwatch::tests {
namespace {

using app::simulation::mix;
using app::simulation::Ray;
using optics::normalized;
using optics::Vec2;
using optics::Vec3;

/// A camera's axes in the room, rows right, down, forward, its position and its focal length.
struct Camera {
  optics::Mat3 axes;
  Vec3 position;
  double focal_length = 0;

  Ray ray(double u, double v, const cv::Size& size) const {
    const Vec3 w{(u - (size.width - 1) * 0.5) / focal_length,
                 (v - (size.height - 1) * 0.5) / focal_length, 1};
    return {position, normalized(transposed(axes) * w)};
  }
};

Camera camera_of(const MirrorRoomSettings& s, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Camera camera;
  camera.focal_length = s.radius * std::sqrt(s.distance * s.distance - 1);
  const Vec3 forward = normalized({unit(random), unit(random), unit(random) * 0.4});
  const double roll = unit(random) * 0.3;
  const Vec3 level = normalized(cross(forward, {0, 0, 1})), down = cross(forward, level);
  camera.axes = {level * std::cos(roll) + down * std::sin(roll),
                 down * std::cos(roll) - level * std::sin(roll), forward};
  const Vec3 towards = normalized({s.off_axis.u * s.width / 2 / camera.focal_length,
                                   s.off_axis.v * s.height / 2 / camera.focal_length, 1});
  camera.position = -(transposed(camera.axes) * (towards * s.distance));
  return camera;
}

/// The limb of a unit sphere at `c` in the camera frame: rays w with (w.c)^2 = |w|^2 (c.c - 1).
TrueLimb limb_of(const Vec3& c, double focal_length, const cv::Size& size) {
  const double k = dot(c, c) - 1;
  const double xx = c.x * c.x - k, yy = c.y * c.y - k, zz = c.z * c.z - k;
  const double xy = c.x * c.y, xz = c.x * c.z, yz = c.y * c.z;
  const double determinant = xx * yy - xy * xy;
  const double u = (xy * yz - yy * xz) / determinant, v = (xy * xz - xx * yz) / determinant;
  const double level = -(zz + xz * u + yz * v);
  const double mean = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
  return {{u * focal_length + (size.width - 1) * 0.5, v * focal_length + (size.height - 1) * 0.5},
          std::sqrt(level / (mean + half)) * focal_length,
          std::sqrt(level / (mean - half)) * focal_length};
}

cv::Mat encode(const cv::Mat& light, const MirrorRoomSettings& s, std::mt19937_64& random) {
  cv::Mat seen;
  cv::GaussianBlur(light, seen, {}, std::max(s.blur, 0.3));
  std::normal_distribution<float> normal;
  const auto noise = [&](std::mt19937_64& from) {
    return static_cast<float>(s.noise) * normal(from);
  };
  if (s.thermal) {
    cv::Mat counts(seen.size(), CV_16UC1);
    for (int v = 0; v < seen.rows; ++v) {
      for (int u = 0; u < seen.cols; ++u) {
        const float kelvin = 291 + 22 * std::min(seen.at<cv::Vec3f>(v, u)[0], 6.F);
        counts.at<std::uint16_t>(v, u) =
            cv::saturate_cast<std::uint16_t>(kelvin * 25 + noise(random));
      }
    }
    return counts;
  }
  cv::Mat samples(seen.size(), CV_8UC3);
  std::vector<float> greens;
  for (int v = 0; v < seen.rows; v += 4) {
    for (int u = 0; u < seen.cols; u += 4) greens.push_back(seen.at<cv::Vec3f>(v, u)[1]);
  }
  const auto median = greens.begin() + static_cast<std::ptrdiff_t>(greens.size() / 2);
  std::nth_element(greens.begin(), median, greens.end());
  const float gain = 0.2F / std::max(*median, 1e-3F) * static_cast<float>(std::exp2(s.exposure));
  for (int v = 0; v < seen.rows; ++v) {
    for (int u = 0; u < seen.cols; ++u) {
      for (int c = 0; c < 3; ++c) {
        const float x = std::clamp(seen.at<cv::Vec3f>(v, u)[2 - c] * gain, 0.F, 1.F);
        const float y = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
        samples.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<std::uint8_t>(y * 255 + noise(random));
      }
    }
  }
  return samples;
}

/// Adds the rod that the ball hangs on, across the line of sight, so that it hides a share of the
/// limb's angles.
void hang(MirrorRoomScene& room, const Camera& camera, const MirrorRoomSettings& settings,
          std::mt19937_64& random) {
  if (!(settings.limb_hidden > 0)) return;
  const double angle = std::uniform_real_distribution<double>(0, 6.28)(random);
  const Vec3 towards = normalized(camera.position);
  const Vec3 side = normalized(cross(towards, {0.1, 0.3, 1})), other = cross(towards, side);
  room.hang(side * std::cos(angle) + other * std::sin(angle),
            std::sin(std::numbers::pi * std::min(settings.limb_hidden, 0.45)));
}

/// Traces the camera's picture; pixels near the limb by 4x4 rays.
MirrorRoomPicture picture(const MirrorRoomScene& room, const Camera& camera,
                          const MirrorRoomSettings& settings, std::mt19937_64& random) {
  const cv::Size size(settings.width, settings.height);
  cv::Mat light(size, CV_32FC3);
  const double limb = std::sqrt(1 - 1 / (settings.distance * settings.distance));
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Ray ray = camera.ray(u, v, size);
      // Parts of the ball where few pixels show much, and the surroundings of its limb.
      const double cosine = -dot(ray.direction, normalized(camera.position));
      const double rho =
          std::tan(std::acos(std::min(1.0, cosine))) / std::sqrt(1 / (limb * limb) - 1);
      const bool inside = settings.ball && rho > 0.7 && rho < 1 + 4 / settings.radius;
      const bool limb_near = inside && rho > 1 - 4 / settings.radius;
      const int side = limb_near ? 4 : inside ? 2 : 1;
      Vec3 sum;
      for (int i = 0; i < side * side; ++i) {
        sum = sum + (side > 1 ? room.light(camera.ray(u + (i % side + 0.5) / side - 0.5,
                                                      v + (i / side + 0.5) / side - 0.5, size))
                              : room.light(ray));
      }
      sum = sum * (1.0 / (side * side));
      light.at<cv::Vec3f>(v, u) = {static_cast<float>(std::min(sum.x, 20.0)),
                                   static_cast<float>(std::min(sum.y, 20.0)),
                                   static_cast<float>(std::min(sum.z, 20.0))};
    }
  }
  const Vec3 ball = camera.axes * -camera.position;
  return {encode(light, settings, random),
          limb_of(ball, camera.focal_length, size),
          camera.focal_length,
          ball,
          camera.axes,
          camera.position,
          {}};
}

}  // namespace

double share_outside(const MirrorRoomSettings& s) {
  constexpr int kPoints = 360;
  int outside = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    const double u = s.off_axis.u * s.width / 2 + s.radius * std::cos(angle);
    const double v = s.off_axis.v * s.height / 2 + s.radius * std::sin(angle);
    outside += std::abs(u) > s.width / 2.0 || std::abs(v) > s.height / 2.0 ? 1 : 0;
  }
  return static_cast<double>(outside) / kPoints;
}

MirrorRoomPicture mirror_room(const MirrorRoomSettings& settings) {
  std::mt19937_64 random(mix(settings.seed ^ 0x5eed));
  MirrorRoomScene room(settings);
  const Camera camera = camera_of(settings, random);
  room.clear_sight(camera.position);
  hang(room, camera, settings, random);
  return picture(room, camera, settings, random);
}

MirrorRoomPair mirror_room_pair(const MirrorRoomSettings& first, const MirrorRoomSettings& second) {
  std::mt19937_64 random(mix(first.seed ^ 0x5eed));
  MirrorRoomScene room(first);
  const Camera a = camera_of(first, random);
  Camera b = camera_of(second, random);
  const auto apart = [&] { return angle_between(a.position, b.position); };
  while (apart() < optics::radians(30) || apart() > optics::radians(150)) {
    b = camera_of(second, random);
  }
  room.clear_sight(a.position);
  room.clear_sight(b.position);
  hang(room, a, first, random);
  const auto seen = [&](const Camera& camera, const MirrorRoomSettings& settings) {
    MirrorRoomScene shown = room;
    if (settings.thermal) shown.warm();
    MirrorRoomPicture taken = picture(shown, camera, settings, random);
    const cv::Size size(settings.width, settings.height);
    taken.mirrored = [room, camera, size](const Vec2& pixel) {
      return room.mirrored(camera.ray(pixel.u, pixel.v, size));
    };
    return taken;
  };
  const MirrorRoomPicture from_a = seen(a, first), from_b = seen(b, second);
  return {from_a, from_b, room.scene(), room.table()};
}

}  // namespace orbwatch::tests
