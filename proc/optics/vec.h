// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace orbwatch::optics {

constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / std::numbers::pi); }

/// A point or direction in space. The declaration that uses it states frame and units. Reentrant.
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator*(double s, const Vec3& a) { return a * s; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
};

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalized(const Vec3& a) { return a * (1 / norm(a)); }
/// Angle between two directions in radians, exact for small angles too.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

/// A half-line in space; `direction` is a unit vector. Frame and unit are stated where it is used.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// A point in a picture: pixels, centres at integers (OpenCV), u right, v down.
struct Vec2 {
  double u = 0;
  double v = 0;
};

/// A 3x3 matrix by rows.
struct Mat3 {
  Vec3 row0{1, 0, 0};
  Vec3 row1{0, 1, 0};
  Vec3 row2{0, 0, 1};

  Vec3 column0() const { return {row0.x, row1.x, row2.x}; }
  Vec3 column1() const { return {row0.y, row1.y, row2.y}; }
  Vec3 column2() const { return {row0.z, row1.z, row2.z}; }

  friend Vec3 operator*(const Mat3& m, const Vec3& v) {
    return {dot(m.row0, v), dot(m.row1, v), dot(m.row2, v)};
  }
};

inline Mat3 transposed(const Mat3& m) { return {m.column0(), m.column1(), m.column2()}; }
inline Mat3 operator*(const Mat3& a, const Mat3& b) {
  const Mat3 columns = transposed(b);
  return {columns * a.row0, columns * a.row1, columns * a.row2};
}

}  // namespace orbwatch::optics
