// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/optics/vec.h"

namespace orbwatch::signals {

/// A symmetric 3x3 matrix.
struct Symmetric3 {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  /// Adds weight a a^T.
  void add(const optics::Vec3& a, double weight) { add(a, a, weight); }

  /// Adds weight (a b^T + b a^T) / 2.
  void add(const optics::Vec3& a, const optics::Vec3& b, double weight) {
    xx += weight * a.x * b.x;
    yy += weight * a.y * b.y;
    zz += weight * a.z * b.z;
    xy += weight * (a.x * b.y + a.y * b.x) / 2;
    xz += weight * (a.x * b.z + a.z * b.x) / 2;
    yz += weight * (a.y * b.z + a.z * b.y) / 2;
  }
};

/// The two larger variances of a covariance matrix and the direction of the largest.
struct PrincipalAxes {
  optics::Vec3 axis;   ///< unit vector
  double largest = 0;  ///< at least 0
  double second = 0;   ///< at least 0
};

/// Uses Jacobi rotations (Golub, Van Loan: Matrix computations, 8.5). Needs no trigonometry.
/// Reentrant.
PrincipalAxes principal_axes(const Symmetric3& covariance);

}  // namespace orbwatch::signals
