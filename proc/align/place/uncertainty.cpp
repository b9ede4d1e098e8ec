#include "proc/align/place/uncertainty.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace orbwatch::align {
namespace {

using optics::Vec3;

using CameraCovariance = Eigen::Matrix<double, kCameraUnknowns, kCameraUnknowns>;

Eigen::Matrix3d eigen(const optics::Mat3& m) {
  Eigen::Matrix3d out;
  out << m.row0.x, m.row0.y, m.row0.z, m.row1.x, m.row1.y, m.row1.z, m.row2.x, m.row2.y, m.row2.z;
  return out;
}

/// The matrix that multiplies by v from the left, as a cross product.
Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d out;
  out << 0, -v.z, v.y, v.z, 0, -v.x, -v.y, v.x, 0;
  return out;
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

/// The direction, in the machine frame, for which a pixel stands.
std::optional<Vec3> direction(const PlaceRequest& request, std::size_t camera,
                              const CameraState& state, const optics::Vec2& pixel) {
  const UnplacedCamera& unplaced = request.cameras[camera];
  const auto lens = lens_at(unplaced, state.log_focal);
  if (!lens) return std::nullopt;
  const auto ball = projection(unplaced, *lens, state, {}, request.ball_radius);
  const auto ray = ball ? ball->ray(pixel) : std::nullopt;
  return ray ? std::optional(ray->direction) : std::nullopt;
}

/// How that direction changes with the camera; nullopt next to the limb.
std::optional<Eigen::Matrix<double, 3, kCameraUnknowns>> slope(const PlaceRequest& request,
                                                               std::size_t camera,
                                                               const CameraState& state,
                                                               const optics::Vec2& pixel) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 3, kCameraUnknowns> all;
  for (int k = 0; k < kCameraUnknowns; ++k) {
    const CameraChange change = CameraChange::Unit(k) * kStep;
    const auto ahead = direction(request, camera, changed(state, change), pixel);
    const auto behind = direction(request, camera, changed(state, -change), pixel);
    if (!ahead || !behind) return std::nullopt;
    const Vec3 d = (*ahead - *behind) * (0.5 / kStep);
    all.col(k) = Eigen::Vector3d(d.x, d.y, d.z);
  }
  return all;
}

}  // namespace

std::optional<Eigen::MatrixXd> covariance(const Equations& equations) {
  const Eigen::MatrixXd j = equations.jacobian(Eigen::all, equations.unknowns);
  const Eigen::VectorXd scale = j.colwise().norm();
  if (!(scale.minCoeff() > 0)) return std::nullopt;
  const Eigen::MatrixXd scaled = j * scale.cwiseInverse().asDiagonal();
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  // The slopes are numeric, good to about eight digits.
  constexpr double kRounding = 1e-7;
  if (j.rows() < j.cols() || !(values.minCoeff() > kRounding * values.maxCoeff())) {
    return std::nullopt;
  }
  const Eigen::MatrixXd root =
      scale.cwiseInverse().asDiagonal() * svd.matrixV() * values.cwiseInverse().asDiagonal();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(equations.jacobian.cols(), equations.jacobian.cols());
  all(equations.unknowns, equations.unknowns) = root * root.transpose();
  return all;
}

cv::Matx66d pose_covariance(const PlaceRequest& request, const PlaceState& state,
                            const Eigen::MatrixXd& all, std::size_t camera) {
  // Position = C - R^T ball, R = exp(turn) R0.
  const CameraState& placed = state.cameras[camera];
  const Eigen::Matrix3d back = eigen(placed.rotation).transpose();
  const Eigen::Index first = Eigen::Index(camera) * kCameraUnknowns;
  const Eigen::Index centre = Eigen::Index(state.cameras.size()) * kCameraUnknowns;
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(6, all.cols());
  const double radius = request.ball_radius;
  change.block<3, 3>(0, first).setIdentity();
  change.block<3, 3>(3, first) = -radius * back * cross_matrix(placed.ball);
  change.block<3, 3>(3, first + 3) = -radius * back;
  change.block<3, 3>(3, centre) = radius * Eigen::Matrix3d::Identity();
  const Eigen::Matrix<double, 6, 6> pose = change * all * change.transpose();
  cv::Matx66d out;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) out(r, c) = pose(r, c);
  }
  return out;
}

double view_sigma(const PlaceRequest& request, const PlaceState& state,
                  const CameraCovariance& covariance, std::size_t camera) {
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
    sum += (*by_change * covariance * by_change->transpose()).trace();
    ++count;
  }
  return count > 0 ? optics::degrees(std::sqrt(sum / count))
                   : std::numeric_limits<double>::infinity();
}

}  // namespace orbwatch::align
