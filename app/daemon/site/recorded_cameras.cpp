// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/recorded_cameras.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace orbwatch::app::daemon {
namespace {

using hal::recording::PictureRegion;

/// Room around the limb, in half axes: the ball may move before the watch says so.
constexpr double kMargin = 0.05;

/// The limb as the rig states it, or as it follows from the pose.
std::optional<optics::Outline> limb_of(const optics::Rig& rig, const optics::RigCamera& camera) {
  if (camera.outline) return camera.outline;
  const auto projection = optics::ball_projection(rig, camera);
  return projection ? projection->outline() : std::nullopt;
}

/// Pixels from `centre - half` to `centre + half`, inside of 0..size.
std::pair<int, int> clipped(double centre, double half, int size) {
  const auto bounded = [size](double place) {
    return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(size)));
  };
  const int begin = bounded(std::floor(centre - half));
  const int end = bounded(std::ceil(centre + half) + 1);
  return {begin, end - begin};
}

/// The rectangle around the ellipse and its margin.
PictureRegion around(const optics::Outline& limb, int width, int height) {
  const double angle = limb.angle * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  const double half_width = (1 + kMargin) * std::hypot(limb.rx * c, limb.ry * s);
  const double half_height = (1 + kMargin) * std::hypot(limb.rx * s, limb.ry * c);
  const auto [x, columns] = clipped(limb.centre.u, half_width, width);
  const auto [y, rows] = clipped(limb.centre.v, half_height, height);
  return {x, y, columns, rows};
}

}  // namespace

std::vector<RecordedCamera> recorded_cameras(const files::Resolved& site,
                                             const std::vector<hal::StreamFormat>& formats) {
  std::vector<RecordedCamera> cameras;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const hal::StreamFormat& format = formats[i];
    const optics::RigCamera& stated = site.rig_camera(i);
    RecordedCamera camera{
        site.names.cameras[i], format, {0, 0, format.width, format.height}, stated.intrinsics};
    const bool is_of_rig = stated.width == format.width && stated.height == format.height;
    const auto limb = is_of_rig ? limb_of(site.rig, stated) : std::nullopt;
    if (limb) camera.ball = around(*limb, format.width, format.height);
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace orbwatch::app::daemon
