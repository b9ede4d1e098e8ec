// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/sphere_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "proc/optics/resolution.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Vec3;
using optics::ViewProjection;

constexpr double kFaceWidth = 120;  // degrees: a cube's corner is 54.7 degrees from its face
// Degrees from the camera; pixels beyond are few and inaccurate.
constexpr double kWidestAngle = 155;

constexpr std::array<optics::YawPitchRoll, 6> kFaces{
    {{0, 0, 0}, {90, 0, 0}, {180, 0, 0}, {-90, 0, 0}, {0, 90, 0}, {0, -90, 0}}};

/// The source coordinates of each of the view's pixels; far outside of the source where nothing is
/// shown.
cv::Mat source_map(const ViewProjection& view, const BallProjection& ball,
                   const std::optional<double>& closeness) {
  const double cosine = std::cos(optics::radians(kWidestAngle));
  cv::Mat map(view.height(), view.width(), CV_32FC2, cv::Scalar::all(-1e6));
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.cols; ++u) {
      const auto direction = view.direction(u, v);
      if (!direction || dot(*direction, ball.facing()) < cosine) continue;
      const auto pixel = pixel_of(ball, *direction, closeness);
      if (!pixel) continue;
      map.at<cv::Vec2f>(v, u) = {static_cast<float>(pixel->u), static_cast<float>(pixel->v)};
    }
  }
  return map;
}

cv::Mat within(const cv::Mat& map, const cv::Size& source) {
  cv::Mat shown;
  cv::inRange(map, cv::Scalar(0, 0), cv::Scalar(source.width - 1, source.height - 1), shown);
  return shown;
}

}  // namespace

std::size_t face_of(const Vec3& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  if (z > x && z > y) return d.z > 0 ? 4 : 5;
  if (x > y) return d.x > 0 ? 1 : 3;
  return d.y > 0 ? 0 : 2;
}

Result<std::vector<SphereFace>> sphere_faces(const cv::Mat& luminance, const BallProjection& ball,
                                             double pixels_per_degree,
                                             const std::optional<double>& closeness) {
  const double focal_length = optics::degrees(pixels_per_degree);
  const int side =
      static_cast<int>(std::ceil(4 * focal_length * std::tan(optics::radians(kFaceWidth / 4))));
  // A source finer than the view would alias.
  const double coarser = best_resolution(ball) / pixels_per_degree;
  cv::Mat source = luminance;
  if (coarser > 1.2) {
    cv::GaussianBlur(luminance, source, {}, 0.5 * std::sqrt(coarser * coarser - 1));
  }
  std::vector<SphereFace> faces;
  for (const optics::YawPitchRoll& orientation : kFaces) {
    const auto view = ViewProjection::make(
        {optics::ViewKind::Stereographic, orientation, kFaceWidth, std::nullopt, side, side});
    if (!view) return tl::unexpected(view.error());
    const cv::Mat map = source_map(*view, ball, closeness);
    SphereFace face{*view, {}, within(map, luminance.size())};
    cv::remap(source, face.pixels, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    faces.push_back(face);
  }
  return faces;
}

double best_resolution(const BallProjection& ball) {
  return optics::resolution(ball, ball.facing());
}

cv::Mat stretched(const cv::Mat& luminance) {
  cv::Mat sorted;
  luminance.reshape(1, 1).convertTo(sorted, CV_32F);
  std::vector<float> samples(sorted.begin<float>(), sorted.end<float>());
  const auto quantile = [&](double share) {
    const auto place =
        samples.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(samples.size()));
    std::nth_element(samples.begin(), place, samples.end());
    return static_cast<double>(*place);
  };
  const double low = quantile(0.01), high = std::max(quantile(0.99), low + 1);
  cv::Mat out;
  luminance.convertTo(out, CV_8U, 255 / (high - low), -255 * low / (high - low));
  return out;
}

}  // namespace orbwatch::align
