// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/tags/mirror_view.h"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "proc/optics/lanes.h"

namespace orbwatch::align {

using optics::BallModel;
using optics::BallProjection;
using optics::Vec3;

Result<BallProjection> unplaced_projection(const optics::Outline& outline,
                                           const std::optional<optics::Lens>& lens) {
  if (!lens) {
    const auto model = BallModel::at_distance(BallModel::Kind::Exact, kUncalibratedDistance);
    return BallProjection::make(model, outline, {});
  }
  const auto sight = optics::sight_from_outline(outline, *lens);
  if (!sight) return tl::unexpected(sight.error());
  // The camera's own axes: X = -right, Y = -forward, Z = -down.
  const optics::Mat3 rotation{{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
  const Vec3 position = transposed(rotation) * sight->axis * -sight->distance;
  return BallProjection::make(BallModel::Kind::Exact, {*lens, {rotation, position}, std::nullopt},
                              {});
}

std::vector<optics::ViewProjection> views_all_around(int side) {
  // A cube's faces and corners; its corners are 35.3 degrees above the horizon.
  constexpr double kCorner = 35.264;
  constexpr std::array<std::array<double, 2>, 13> kAxes{{{0, 0},
                                                         {-90, 0},
                                                         {90, 0},
                                                         {0, 90},
                                                         {0, -90},
                                                         {-45, kCorner},
                                                         {45, kCorner},
                                                         {-45, -kCorner},
                                                         {45, -kCorner},
                                                         {-135, kCorner},
                                                         {135, kCorner},
                                                         {-135, -kCorner},
                                                         {135, -kCorner}}};
  std::vector<optics::ViewProjection> views;
  for (const auto& [yaw, pitch] : kAxes) {
    optics::ViewSpec spec;
    spec.orientation = {yaw, pitch, 0};
    spec.h_fov = 100;
    spec.width = spec.height = side;
    views.push_back(optics::ViewProjection::make(spec).value());
  }
  return views;
}

cv::Mat mirror_view(const cv::Mat& luminance, const BallProjection& ball,
                    const optics::ViewProjection& view) {
  cv::Mat map(view.height(), view.width(), CV_32FC2);
  const optics::Lanes far_away{};
  optics::Vec2Lanes pixels;
  optics::Vec3Lanes directions;
  for (int row = 0; row < map.rows; ++row) {
    auto* const out = map.ptr<cv::Vec2f>(row);
    for (int first = 0; first < map.cols; first += int(optics::kLanes)) {
      for (std::size_t k = 0; k < optics::kLanes; ++k) {
        pixels.u[k] = first + int(k);
        pixels.v[k] = row;
      }
      view.directions(pixels, directions);
      ball.pixels(directions, far_away, pixels);
      for (std::size_t k = 0; k < optics::kLanes && first + int(k) < map.cols; ++k) {
        const bool shown = std::isfinite(pixels.u[k] + pixels.v[k]);
        out[first + int(k)] =
            shown ? cv::Vec2f(float(pixels.u[k]), float(pixels.v[k])) : cv::Vec2f(-2, -2);
      }
    }
  }
  cv::Mat out;
  cv::remap(luminance, out, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_CONSTANT);
  return out;
}

}  // namespace orbwatch::align
