// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/plane_map.h"

#include <cassert>
#include <cstdlib>

namespace orbwatch::remap {
namespace {

constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
constexpr std::int64_t kHalfPixel = std::int64_t{kHalf} << PatchRow::kScaleBits;

constexpr int kSlopeShift = PatchRow::kScaleBits - UvQuadratic::kSlopeBits;

/// Sum x + y of both axes.
Uv64 sum(UvXy32 value) {
  const UvXy32 folded = value + __builtin_shufflevector(value, value, 2, 3, 0, 1);
  return Uv64{folded[0], folded[1]};
}

/// Maps to the chroma of 4:2:0 in both pictures: (X, Y) -> (2 X + 1/2, 2 Y + 1/2), and c -> (c -
/// 1/2) / 2.
UvQuadratic in_quarters(const UvQuadratic& q) {
  const Uv64 bulge = sum(q.curve + (q.cross >> 1)) >> 2;
  const Uv64 middle = q.value + (sum(q.slope) << (kSlopeShift - 1)) + bulge;
  return {(middle - kHalfPixel) >> 1,
          q.slope + (q.curve >> kSlopeShift) + (q.cross >> (kSlopeShift + 1)), q.curve << 1,
          q.cross << 1};
}

/// Maps to the chroma of 4:2:2 in both pictures: X -> 2 X, u -> u / 2.
UvQuadratic in_halves(const UvQuadratic& q) {
  return {q.value >> Uv64{1, 0}, (q.slope * UvXy32{2, 4, 1, 2}) >> 1,
          (q.curve * UvXy32{4, 8, 1, 2}) >> 1, (q.cross * UvXy32{2, 4, 2, 4}) >> 1};
}

constexpr UvXy32 kAlongX{1, 1, 0, 0}, kAlongY{0, 0, 1, 1};

/// Half steps along one axis, from the same place on.
UvQuadratic halved(const UvQuadratic& q, UvXy32 axis) {
  return {q.value, q.slope >> axis, q.curve >> (axis << 1), q.cross >> 1};
}

/// The same from a quarter of a pixel before; `slope` and `curve`: those along the axis.
Patch quarter_before(const UvQuadratic& q, UvXy32 axis, Uv64 slope, Uv64 curve) {
  UvQuadratic half = halved(q, axis);
  half.value -= (slope << (kSlopeShift - 2)) - (curve >> 4);
  half.slope -= (axis != 0 ? q.curve : q.cross) >> (kSlopeShift + 2);
  return Patch(half);
}

/// Half of a picture's coordinate; between two pixels' centres if it is centred.
std::int32_t in_source(std::int32_t c, Siting siting) {
  if (siting == Siting::Full) return c;
  return (siting == Siting::Centred ? c - kHalf : c) >> 1;
}

/// Distance above which pixels that share one of the plane lie on two sides of an edge.
constexpr std::int32_t kApart = 4 << kFractionBits;

/// The coordinate shared by `columns` x `rows` pixels from (x, y) on.
Coordinate shared(const CoordinateTile& tile, int x, int y, int columns, int rows, bool centred) {
  Coordinate sum{}, first{kBlind, 0};
  int defined = 0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Coordinate& c = tile[y + j][x + i];
      if (!is_defined(c)) {
        if (defined == 0 && c.u == kOutside) first.u = kOutside;
        continue;
      }
      if (defined == 0) first = c;
      const Coordinate apart{c.u - first.u, c.v - first.v};
      if (std::abs(apart.u) > kApart || std::abs(apart.v) > kApart) continue;
      sum = {sum.u + apart.u, sum.v + apart.v};
      ++defined;
    }
  }
  if (!centred || defined < columns * rows) return first;
  return {first.u + sum.u / defined, first.v + sum.v / defined};
}

}  // namespace

Patch on_level(Patch patch, int level) {
  const UvQuadratic& q = patch.axes();
  return Patch(UvQuadratic{((q.value + kHalfPixel) >> level) - kHalfPixel, q.slope >> level,
                           q.curve >> level, q.cross >> level});
}

void on_level(CoordinateTile& tile, int level) {
  for (CoordinateRow& row : tile) {
    for (Coordinate& c : row) {
      if (is_defined(c)) c = {((c.u + kHalf) >> level) - kHalf, ((c.v + kHalf) >> level) - kHalf};
    }
  }
}

Patch in_steps(Patch patch, int bits) {
  const UvQuadratic& q = patch.axes();
  return Patch(UvQuadratic{q.value, q.slope << bits, q.curve << (2 * bits), q.cross << (2 * bits)});
}

Patch at_half_steps(Patch patch) {
  const UvQuadratic& q = patch.axes();
  const Uv64 bulge = sum(q.curve + (q.cross >> 1)) >> 4;
  return Patch(
      UvQuadratic{q.value - (sum(q.slope) << (kSlopeShift - 2)) + bulge,
                  (q.slope >> 1) - (q.curve >> (kSlopeShift + 2)) - (q.cross >> (kSlopeShift + 3)),
                  q.curve >> 2, q.cross >> 2});
}

Patch at_half_steps_along_x(Patch patch) {
  const UvQuadratic& q = patch.axes();
  return quarter_before(q, kAlongX, Uv64{q.slope[0], q.slope[1]}, Uv64{q.curve[0], q.curve[1]});
}

Patch at_half_steps_along_y(Patch patch) {
  const UvQuadratic& q = patch.axes();
  return quarter_before(q, kAlongY, Uv64{q.slope[2], q.slope[3]}, Uv64{q.curve[2], q.curve[3]});
}

Patch at_half_rows(Patch patch) { return Patch(halved(patch.axes(), kAlongY)); }

Patch at_half_columns(Patch patch) { return Patch(halved(patch.axes(), kAlongX)); }

UvXy32 slope_at(const Patch& patch, int x, int y) {
  const UvQuadratic& q = patch.axes();
  const UvXy32 along{x, x, y, y}, across{y, y, x, x};
  return q.slope + ((2 * along * q.curve + across * q.cross) >> kSlopeShift);
}

Patch moved(Patch patch, int x, int y) {
  const UvQuadratic& q = patch.axes();
  const auto there = [x, y](const Quadratic& axis) {
    return axis.value + x * (axis.x + x * axis.xx + y * axis.xy) + y * (axis.y + y * axis.yy);
  };
  return Patch(UvQuadratic{Uv64{there(patch.u()), there(patch.v())}, slope_at(patch, x, y), q.curve,
                           q.cross});
}

Patch on_plane(Patch patch, const PlaneSampling& sampling) {
  if (sampling.x == Siting::Full) return patch;
  assert(sampling.x == (sampling.y == Siting::Full ? Siting::Cosited : Siting::Centred));
  return Patch(sampling.y == Siting::Full ? in_halves(patch.axes()) : in_quarters(patch.axes()));
}

void on_plane(const CoordinateTile& picture, const PlaneSampling& sampling, CoordinateTile& plane) {
  const int columns = 1 << shift(sampling.x), rows = 1 << shift(sampling.y);
  const bool centred = sampling.x == Siting::Centred || sampling.y == Siting::Centred;
  for (int y = 0; y < kTile / rows; ++y) {
    for (int x = 0; x < kTile / columns; ++x) {
      const Coordinate c = shared(picture, x * columns, y * rows, columns, rows, centred);
      plane[y][x] =
          is_defined(c) ? Coordinate{in_source(c.u, sampling.x), in_source(c.v, sampling.y)} : c;
    }
  }
}

}  // namespace orbwatch::remap
