// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/uncertainty.h"

#include <cmath>
#include <numbers>

namespace orbwatch::align {
namespace {

using optics::Vec3;

using optics::Mat3;

/// The matrix of the cross product v x.
Mat3 cross_matrix(const Vec3& v) { return {{0, -v.z, v.y}, {v.z, 0, -v.x}, {-v.y, v.x, 0}}; }

void set_block(cv::Mat1d& all, int row, int column, const Mat3& block, double factor) {
  int r = row;
  for (const Vec3& v : {block.row0, block.row1, block.row2}) {
    all(r, column) = factor * v.x;
    all(r, column + 1) = factor * v.y;
    all(r++, column + 2) = factor * v.z;
  }
}

/// Directions all over the sphere, each for the same solid angle (a Fibonacci lattice).
std::vector<Vec3> sphere() {
  constexpr int kCount = 200;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> all;
  for (int n = 0; n < kCount; ++n) {
    const double z = 1 - (2 * n + 1.0) / kCount, across = std::sqrt(1 - z * z);
    all.push_back({across * std::cos(golden * n), across * std::sin(golden * n), z});
  }
  return all;
}

/// The direction, in the machine frame, that a pixel shows.
std::optional<Vec3> direction(const PlaceRequest& request, std::size_t camera,
                              const CameraState& state, const optics::Vec2& pixel) {
  const UnplacedCamera& unplaced = request.cameras[camera];
  const auto lens = lens_at(unplaced, state.log_focal);
  if (!lens) return std::nullopt;
  const auto ball = projection(unplaced, *lens, state, {}, request.ball_radius);
  const auto ray = ball ? ball->ray(pixel) : std::nullopt;
  return ray ? std::optional(ray->direction) : std::nullopt;
}

/// Derivative of that direction with respect to the camera's unknowns; nullopt next to the limb.
std::optional<cv::Matx<double, 3, kCameraUnknowns>> slope(const PlaceRequest& request,
                                                          std::size_t camera,
                                                          const CameraState& state,
                                                          const optics::Vec2& pixel) {
  constexpr double kStep = 1e-6;
  cv::Matx<double, 3, kCameraUnknowns> all;
  for (int k = 0; k < kCameraUnknowns; ++k) {
    CameraChange change;
    change[k] = kStep;
    const auto ahead = direction(request, camera, changed(state, change), pixel);
    const auto behind = direction(request, camera, changed(state, -change), pixel);
    if (!ahead || !behind) return std::nullopt;
    const Vec3 d = (*ahead - *behind) * (0.5 / kStep);
    all(0, k) = d.x;
    all(1, k) = d.y;
    all(2, k) = d.z;
  }
  return all;
}

}  // namespace

std::optional<cv::Mat1d> covariance(const Equations& equations) {
  const cv::Mat1d& jacobian = equations.jacobian;
  const int count = int(equations.unknowns.size());
  if (jacobian.rows < count) return std::nullopt;
  cv::Mat1d scaled(jacobian.rows, count);
  std::vector<double> scale;
  for (int k = 0; k < count; ++k) {
    const cv::Mat1d column = jacobian.col(equations.unknowns[std::size_t(k)]);
    scale.push_back(cv::norm(column));
    if (!(scale.back() > 0)) return std::nullopt;
    column.convertTo(scaled.col(k), CV_64F, 1 / scale.back());
  }
  cv::Mat1d values, left, right;  // the values in descending order, `right` by rows
  cv::SVD::compute(scaled, values, left, right);
  // The slopes are numeric, good to about eight digits.
  constexpr double kRounding = 1e-7;
  if (!(values(count - 1) > kRounding * values(0))) return std::nullopt;
  cv::Mat1d root(count, count);
  for (int r = 0; r < count; ++r) {
    for (int c = 0; c < count; ++c) root(r, c) = right(c, r) / (scale[std::size_t(r)] * values(c));
  }
  const cv::Mat1d known = root * root.t();
  cv::Mat1d all = cv::Mat1d::zeros(jacobian.cols, jacobian.cols);
  for (int r = 0; r < count; ++r) {
    double* const row = all[equations.unknowns[std::size_t(r)]];
    for (int c = 0; c < count; ++c) row[equations.unknowns[std::size_t(c)]] = known(r, c);
  }
  return all;
}

cv::Matx66d pose_covariance(const PlaceRequest& request, const PlaceState& state,
                            const cv::Mat1d& all, std::size_t camera) {
  // Position = C - R^T ball, R = exp(turn) R0.
  const CameraState& placed = state.cameras[camera];
  const Mat3 back = transposed(placed.rotation);
  const int first = int(camera) * kCameraUnknowns;
  const int centre = int(state.cameras.size()) * kCameraUnknowns;
  const double radius = request.ball_radius;
  cv::Mat1d change = cv::Mat1d::zeros(6, all.cols);
  set_block(change, 0, first, Mat3{}, 1);
  set_block(change, 3, first, back * cross_matrix(placed.ball), -radius);
  set_block(change, 3, first + 3, back, -radius);
  set_block(change, 3, centre, Mat3{}, radius);
  const cv::Mat1d pose = change * all * change.t();
  return pose;
}

double view_sigma(const PlaceRequest& request, const PlaceState& state, const cv::Mat1d& all,
                  std::size_t camera) {
  const int first = int(camera) * kCameraUnknowns;
  const cv::Matx<double, kCameraUnknowns, kCameraUnknowns> covariance =
      all(cv::Rect(first, first, kCameraUnknowns, kCameraUnknowns));
  const UnplacedCamera& unplaced = request.cameras[camera];
  const CameraState& placed = state.cameras[camera];
  const auto lens = lens_at(unplaced, placed.log_focal);
  const auto ball =
      lens ? projection(unplaced, *lens, placed, {}, request.ball_radius) : std::nullopt;
  if (!ball) return std::numeric_limits<double>::infinity();
  const double least = std::cos(optics::radians(150));
  double sum = 0;
  int count = 0;
  for (const Vec3& towards : sphere()) {
    if (dot(towards, ball->facing()) < least) continue;
    const auto pixel = ball->pixel(towards);
    if (!pixel || !(pixel->u >= -0.5 && pixel->u <= unplaced.lens.width - 0.5) ||
        !(pixel->v >= -0.5 && pixel->v <= unplaced.lens.height - 0.5)) {
      continue;
    }
    const auto by_change = slope(request, camera, placed, *pixel);
    if (!by_change) continue;
    sum += cv::trace(*by_change * covariance * by_change->t());
    ++count;
  }
  return count > 0 ? optics::degrees(std::sqrt(sum / count))
                   : std::numeric_limits<double>::infinity();
}

}  // namespace orbwatch::align
