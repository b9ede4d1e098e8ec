// SPDX-License-Identifier: Apache-2.0
#include "proc/align/rotation_fit.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace orbwatch::align {
namespace {

using optics::Mat3;
using optics::Vec3;

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

Vec3 row(const Eigen::Matrix3d& m, int n) { return {m(n, 0), m(n, 1), m(n, 2)}; }

Mat3 matrix(const Eigen::Matrix3d& m) { return {row(m, 0), row(m, 1), row(m, 2)}; }

}  // namespace

Mat3 fit_rotation(std::span<const DirectionPair> pairs) {
  Eigen::Matrix3d profile = Eigen::Matrix3d::Zero();
  for (const DirectionPair& pair : pairs) {
    profile += pair.weight * eigen(pair.reference) * eigen(pair.camera).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(profile, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) = -u.col(2);
  return matrix(u * svd.matrixV().transpose());
}

Mat3 rotation_about(const Vec3& turn) {
  const double angle = norm(turn);
  if (!(angle > 0)) return {};
  return matrix(Eigen::AngleAxisd(angle, eigen(turn * (1 / angle))).toRotationMatrix());
}

double angle_between(const Mat3& a, const Mat3& b) {
  const Mat3 turn = a * transposed(b);
  const Vec3 twice_sine{turn.row2.y - turn.row1.z, turn.row0.z - turn.row2.x,
                        turn.row1.x - turn.row0.y};
  return std::atan2(norm(twice_sine), turn.row0.x + turn.row1.y + turn.row2.z - 1);
}

}  // namespace orbwatch::align
