// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "proc/optics/vec.h"

/// The 3x3 matrices of small least squares. Plain functions: a matrix library costs seconds in
/// every file that includes it. Reentrant.
namespace orbwatch::align {

inline optics::Mat3 operator+(const optics::Mat3& a, const optics::Mat3& b) {
  return {a.row0 + b.row0, a.row1 + b.row1, a.row2 + b.row2};
}

inline optics::Mat3 operator*(const optics::Mat3& m, double by) {
  return {m.row0 * by, m.row1 * by, m.row2 * by};
}

/// Outer product a b^T.
inline optics::Mat3 outer(const optics::Vec3& a, const optics::Vec3& b) {
  return {b * a.x, b * a.y, b * a.z};
}

inline double determinant(const optics::Mat3& m) { return dot(m.row0, cross(m.row1, m.row2)); }

/// The inverse; not finite for a singular matrix.
inline optics::Mat3 inverse(const optics::Mat3& m) {
  const optics::Mat3 columns{cross(m.row1, m.row2), cross(m.row2, m.row0), cross(m.row0, m.row1)};
  return transposed(columns) * (1 / determinant(m));
}

/// Sylvester's criterion, for a symmetric matrix.
inline bool is_positive_definite(const optics::Mat3& m) {
  return m.row0.x > 0 && m.row0.x * m.row1.y - m.row0.y * m.row1.x > 0 && determinant(m) > 0;
}

/// The root of the sum of squares.
inline double frobenius_norm(const optics::Mat3& m) {
  return std::sqrt(dot(m.row0, m.row0) + dot(m.row1, m.row1) + dot(m.row2, m.row2));
}

}  // namespace orbwatch::align
