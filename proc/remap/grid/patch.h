// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// One row of a patch: source coordinates by forward differences, exact in integers, so that every
/// kernel on every architecture steps through the same values.
struct PatchRow {
  static constexpr int kScaleBits = 11;  ///< values are Q(13 + 11)
  std::int64_t u, du, ddu;
  std::int64_t v, dv, ddv;

  Coordinate current() const {
    constexpr std::int64_t kHalf = std::int64_t{1} << (kScaleBits - 1);
    return {static_cast<std::int32_t>((u + kHalf) >> kScaleBits),
            static_cast<std::int32_t>((v + kHalf) >> kScaleBits)};
  }
  void step() {
    u += du;
    du += ddu;
    v += dv;
    dv += ddv;
  }
  /// Writes the first `count` coordinates of the row, the same as current() and step().
  void write(int count, Coordinate* out) const;
};

/// The 4x4 nodes that a patch between the middle four is made from.
struct Stencil {
  std::array<Coordinate, 16> nodes;

  /// Column i and row j, -1..2; the patch lies between 0 and 1.
  const Coordinate& at(int i, int j) const { return nodes[(j + 1) * 4 + i + 1]; }
  Coordinate& at(int i, int j) { return nodes[(j + 1) * 4 + i + 1]; }
};

/// Nodes around `corner`, a patch's upper left, in rows `stride` nodes apart.
struct PatchNodes {
  const Coordinate* corner;
  std::ptrdiff_t stride;
};

/// True if `good(i, j)` holds for the twelve nodes that a patch depends on.
template <class Good>
bool all_nodes(const Good& good) {
  for (int j = -1; j <= 2; ++j) {
    const bool outer = j == -1 || j == 2;
    for (int i = outer ? 0 : -1; i <= (outer ? 1 : 2); ++i) {
      if (!good(i, j)) return false;
    }
  }
  return true;
}

/// One axis of a patch in Q(13 + 11): value + x X + y Y + xy X Y + xx X^2 + yy Y^2. X, Y count
/// pixels of the tile.
struct Quadratic {
  std::int64_t value, x, y, xy, xx, yy;
};

// One register each, since a frame has thousands of patches: Uv64 holds a number for u and one for
// v; UvXy32 one for each of u and v along x, and then along y.
using Uv64 [[gnu::vector_size(16)]] = std::int64_t;
using UvXy32 [[gnu::vector_size(16)]] = std::int32_t;

/// Both axes of a patch in the layout of registers.
struct UvQuadratic {
  static constexpr int kSlopeBits = 7;  ///< Q(13 + 7), which is exact for a patch on nodes

  Uv64 value;    ///< Q24
  UvXy32 slope;  ///< x and y, Q20
  UvXy32 curve;  ///< xx and yy, Q24
  UvXy32 cross;  ///< xy, Q24; stored twice
};

/// The smooth map between four nodes: bilinear, plus the mean of the second differences along each
/// axis. Positions x, y count sixteenths of the way from node to node. Reentrant.
class Patch {
 public:
  /// Depends on twelve nodes, not on the four outermost corners. Precondition: these are defined
  /// and not too steep (see is_too_steep()).
  explicit Patch(PatchNodes nodes);
  explicit Patch(const Stencil& stencil) : Patch(PatchNodes{&stencil.at(0, 0), 4}) {}
  explicit Patch(const UvQuadratic& axes) : axes_(axes) {}
  /// Precondition: at most as steep as a patch on nodes can be; slopes are rounded down to Q20.
  Patch(const Quadratic& u, const Quadratic& v);

  Quadratic u() const { return axis(0); }
  Quadratic v() const { return axis(1); }
  const UvQuadratic& axes() const { return axes_; }

  /// Row `y`, 0..15, at x = 0.
  PatchRow row(int y) const;

  /// The coordinate at x, y in 0..15.
  Coordinate at(int x, int y) const;

  /// Bounds of the patch's coordinates; nearly tight.
  struct Range {
    Coordinate low;
    Coordinate high;
  };
  Range range() const;

 private:
  Quadratic axis(int n) const;

  UvQuadratic axes_;
};

/// The error of a patch against the map of its nodes, in Q13 pixels, estimated from the nodes: the
/// third-order terms in the distance between nodes. Along x they are t (1-t) (2t-1) / 12 of the
/// third difference, at most kThirdDifference of it, and t (1-t) / 2 of the deviation of this row's
/// second difference from the mean, at most kChangeAcross of its change from row to row.
inline constexpr double kThirdDifference = 0.0081;
inline constexpr double kChangeAcross = 1.0 / 16;
double third_order_error(const Stencil& stencil);

/// The steepest map that is kept in patches: source pixels per pixel of a view, along one axis. Up
/// to it no sum of a patch's numbers overflows, also where a plane or a mip level is sampled.
inline constexpr int kSteepest = 16;

/// True if neighbours among those nodes, `pixels` of a view apart, are further apart in the source
/// than kSteepest allows.
bool is_too_steep(const Stencil& stencil, int pixels);

}  // namespace orbwatch::remap
