// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <string>

#include "proc/optics/vec.h"

/// Cameras around a ball in a distant room of smooth colours, painted by plain vector reflection.
namespace orbwatch::tests {

/// Exposure and white balance: the camera delivers (light - offset) / gain.
struct Exposure {
  double gain_red = 1;
  double gain_green = 1;
  double gain_blue = 1;
};

/// Light of the room in a direction, 0..1, red green blue.
inline cv::Vec3d room_light(const optics::Vec3& v) {
  return {0.3 + 0.12 * v.x + 0.05 * std::sin(4 * v.z), 0.3 + 0.1 * v.y + 0.06 * std::cos(3 * v.x),
          0.3 - 0.1 * v.z + 0.06 * v.x * v.y};
}

/// 8-bit sRGB sample of light.
inline std::uint8_t srgb(double light) {
  const double c = std::clamp(light, 0.0, 1.0);
  const double sample = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * sample));
}

/// Camera on a horizontal circle around the ball, in the direction `yaw` from it, which looks
/// straight at the ball's centre.
struct PaintedCamera {
  static constexpr double kDistance = 12;  ///< ball radii
  static constexpr double kRadius = 50;    ///< radius of the ball, mm
  static constexpr int kSide = 300;        ///< px
  static constexpr double kLimb = 140;     ///< radius of the ball in the picture, px
  static constexpr optics::Vec3 kCentre{120, 60, 430};

  std::string name;
  double yaw;  ///< degrees

  static double focal_length() { return kLimb * std::sqrt(kDistance * kDistance - 1); }

  optics::Vec3 facing() const {
    const double angle = yaw * std::numbers::pi / 180;
    return {std::sin(angle), std::cos(angle), 0};
  }
  optics::Vec3 right() const { return optics::cross(forward(), {0, 0, 1}); }
  optics::Vec3 forward() const { return -facing(); }

  /// Direction of a pixel's ray after its reflection on the ball.
  std::optional<optics::Vec3> reflected(double u, double v) const {
    constexpr double kMiddle = (kSide - 1) / 2.0;
    const double x = (u - kMiddle) / focal_length(), y = (v - kMiddle) / focal_length();
    const optics::Vec3 ray =
        optics::normalized(forward() + right() * x + optics::Vec3{0, 0, -1} * y);
    const optics::Vec3 from = facing() * kDistance;
    const double along = optics::dot(from, ray);
    const double under_root = along * along - (kDistance * kDistance - 1);
    if (under_root < 0) return std::nullopt;
    const optics::Vec3 normal = from + ray * (-along - std::sqrt(under_root));
    return ray - normal * (2 * optics::dot(ray, normal));
  }

  /// Picture that the camera delivers, blue green red; the room behind the ball is black.
  cv::Mat picture(const Exposure& exposure = {}) const {
    cv::Mat out(kSide, kSide, CV_8UC3, cv::Scalar::all(0));
    for (int v = 0; v < kSide; ++v) {
      for (int u = 0; u < kSide; ++u) {
        const auto direction = reflected(u, v);
        if (!direction) continue;
        const cv::Vec3d light = room_light(*direction);
        out.at<cv::Vec3b>(v, u) = {srgb(light[2] / exposure.gain_blue),
                                   srgb(light[1] / exposure.gain_green),
                                   srgb(light[0] / exposure.gain_red)};
      }
    }
    return out;
  }

  /// Table of the camera in a rig file.
  std::string calibrated() const {
    const auto list = [](const optics::Vec3& v) {
      std::ostringstream text;
      text.precision(17);
      text << v.x << ", " << v.y << ", " << v.z;
      return text.str();
    };
    std::ostringstream text;
    text.precision(17);
    text << "[[camera]]\nname = \"" << name << "\"\nwidth = " << kSide << "\nheight = " << kSide
         << "\n[camera.intrinsics]\nfx = " << focal_length() << "\nfy = " << focal_length()
         << "\ncx = " << (kSide - 1) / 2.0 << "\ncy = " << (kSide - 1) / 2.0
         << "\n[camera.pose]\nposition = [" << list(kCentre + facing() * (kDistance * kRadius))
         << "]\nrotation = [" << list(right()) << ", 0, 0, -1, " << list(forward()) << "]\n";
    return text.str();
  }
};

/// Table of the ball in a rig file.
inline std::string painted_ball() { return "[ball]\ncentre = [120, 60, 430]\nradius = 50\n"; }

}  // namespace orbwatch::tests
