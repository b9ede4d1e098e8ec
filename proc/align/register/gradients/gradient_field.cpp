// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/gradients/gradient_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "proc/align/register/spiral.h"

namespace orbwatch::align {
namespace {

using optics::Vec3;
using optics::ViewProjection;

constexpr double kLeast = 0.5;  // least length of a gradient used

/// A picture smoothed over its shown part only, so that its end is not an edge.
struct Smooth {
  cv::Mat pixels;
  cv::Mat inside;  ///< 8 bit: far enough from that end
};

Smooth smooth(const SphereFace& face, double sigma) {
  cv::Mat weight, pixels, total;
  face.shown.convertTo(weight, CV_32F, 1.0 / 255);
  face.pixels.convertTo(pixels, CV_32F);
  pixels = pixels.mul(weight);
  cv::GaussianBlur(pixels, pixels, {}, sigma);
  cv::GaussianBlur(weight, total, {}, sigma);
  cv::divide(pixels, cv::max(total, 1e-6F), pixels);
  const int margin = static_cast<int>(std::ceil(1.5 * sigma));
  cv::Mat inside;
  cv::erode(face.shown, inside,
            cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * margin + 1, 2 * margin + 1}));
  return {pixels, inside};
}

/// Converts a value's change from pixel to pixel into a change along the sphere, per radian.
Vec3 along_sphere(const ViewProjection& view, int u, int v, double du, double dv) {
  const auto left = view.direction(u - 0.5, v), right = view.direction(u + 0.5, v);
  const auto top = view.direction(u, v - 0.5), bottom = view.direction(u, v + 0.5);
  if (!left || !right || !top || !bottom) return {};
  const Vec3 x = *right - *left, y = *bottom - *top;
  return x * (du / dot(x, x)) + y * (dv / dot(y, y));
}

cv::Vec3f vector(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

cv::Mat gradients(const SphereFace& face, double sigma) {
  const auto [pixels, inside] = smooth(face, sigma);
  cv::Mat du, dv;
  cv::Scharr(pixels, du, CV_32F, 1, 0, 1.0 / 32);
  cv::Scharr(pixels, dv, CV_32F, 0, 1, 1.0 / 32);
  cv::Mat out(pixels.size(), CV_32FC3, cv::Scalar::all(std::numeric_limits<float>::quiet_NaN()));
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      if (inside.at<std::uint8_t>(v, u) == 0) continue;
      const double x = static_cast<double>(du.at<float>(v, u));
      const double y = static_cast<double>(dv.at<float>(v, u));
      out.at<cv::Vec3f>(v, u) = vector(along_sphere(face.view, u, v, x, y));
    }
  }
  return out;
}

}  // namespace

GradientField::GradientField(const std::vector<SphereFace>& faces, double smoothing) {
  double sum = 0;
  int count = 0;
  for (const SphereFace& face : faces) {
    faces_.push_back({face.view, gradients(face, smoothing)});
    for (const cv::Vec3f& g : cv::Mat_<cv::Vec3f>(faces_.back().gradients)) {
      if (std::isnan(g[0])) continue;
      sum += cv::norm(g);
      ++count;
    }
  }
  const auto average = static_cast<float>(sum / std::max(count, 1)) + 1e-6F;
  for (Face& face : faces_) {
    for (int v = 0; v < face.gradients.rows; ++v) {
      for (int u = 0; u < face.gradients.cols; ++u) {
        cv::Vec3f& g = face.gradients.at<cv::Vec3f>(v, u);
        g /= std::sqrt(g.dot(g) + average * average);
      }
    }
  }
}

std::optional<Vec3> GradientField::at(const Vec3& direction) const {
  const Face& face = faces_[face_of(direction)];
  const auto pixel = face.view.pixel(direction);
  if (!pixel) return std::nullopt;
  const int u = static_cast<int>(std::floor(pixel->u)), v = static_cast<int>(std::floor(pixel->v));
  if (u < 0 || v < 0 || u + 1 >= face.gradients.cols || v + 1 >= face.gradients.rows) {
    return std::nullopt;
  }
  const auto a = static_cast<float>(pixel->u - u), b = static_cast<float>(pixel->v - v);
  const cv::Vec3f* const top = face.gradients.ptr<cv::Vec3f>(v) + u;
  const cv::Vec3f* const bottom = face.gradients.ptr<cv::Vec3f>(v + 1) + u;
  const cv::Vec3f g =
      (top[0] * (1 - a) + top[1] * a) * (1 - b) + (bottom[0] * (1 - a) + bottom[1] * a) * b;
  if (std::isnan(g[0])) return std::nullopt;
  return Vec3{static_cast<double>(g[0]), static_cast<double>(g[1]), static_cast<double>(g[2])};
}

std::vector<GradientField::Sample> GradientField::samples(int directions) const {
  std::vector<Sample> all;
  for (int n = 0; n < directions; ++n) {
    const Vec3 direction = spiral(n, directions);
    const auto gradient = at(direction);
    if (!gradient || norm(*gradient) < kLeast) continue;
    const std::size_t octant =
        (direction.x > 0 ? 1U : 0U) + (direction.y > 0 ? 2U : 0U) + (direction.z > 0 ? 4U : 0U);
    const double x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z);
    const std::size_t third = z > x && z > y ? 2 : y > x ? 1 : 0;
    all.push_back({direction, *gradient, 3 * octant + third});
  }
  return all;
}

}  // namespace orbwatch::align
