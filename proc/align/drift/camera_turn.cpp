// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/camera_turn.h"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace orbwatch::align {
namespace {

using optics::Mat3;
using optics::Vec2;
using optics::Vec3;

constexpr int kPoints = 36;
/// Shares of the radius, spread like the patches that a motion is fitted to: a turn changes the
/// picture only approximately by a similarity, which fits best there.
constexpr std::array kRings{0.5, 0.7, 0.85, 0.95};

cv::Vec3d vector(const Vec3& v) { return {v.x, v.y, v.z}; }

Mat3 matrix(const cv::Matx33d& m) {
  return {{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
}

}  // namespace

std::optional<Mat3> camera_turn(const optics::Lens& lens, const optics::Outline& outline,
                                const PictureMotion& motion) {
  cv::Matx33d products = cv::Matx33d::zeros();
  for (const double ring : kRings) {
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * std::numbers::pi * i / kPoints;
      const Vec2 pixel{outline.centre.u + ring * outline.rx * std::cos(angle),
                       outline.centre.v + ring * outline.rx * std::sin(angle)};
      const auto was = lens.direction(pixel);
      const auto is = lens.direction(after(motion, outline, pixel));
      if (!was || !is) return std::nullopt;
      products += vector(*is) * vector(*was).t();
    }
  }
  cv::Matx33d u, vt;
  cv::Matx31d w;
  cv::SVD::compute(products, w, u, vt);
  const double handed = cv::determinant(u * vt) > 0 ? 1 : -1;
  return matrix(u * cv::Matx33d::diag({1, 1, handed}) * vt);
}

}  // namespace orbwatch::align
