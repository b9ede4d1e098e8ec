#include "proc/remap/plane_map.h"

#include <cstdlib>

namespace orbwatch::remap {
namespace {

using Axes = BasicQuadratic<Both>;

constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
constexpr std::int64_t kHalfPixel = std::int64_t{kHalf} << PatchRow::kScaleBits;

// Shifts, for there is no vector multiplication of 64 bit.

/// X -> 2 X, or 2 X + 1/2.
Axes every_second_column(const Axes& q, Siting siting) {
  Axes out{q.value, q.x << 1, q.y, q.xy << 1, q.xx << 2, q.yy};
  if (siting == Siting::Centred) {
    out.value += ((q.x << 1) + q.xx) >> 2;
    out.x += q.xx << 1;
    out.y += q.xy >> 1;
  }
  return out;
}

/// X -> X / 2 - 1/4
Axes half_steps(const Axes& q) {
  return {q.value - (q.x >> 2) + (q.xx >> 4),
          (q.x >> 1) - (q.xx >> 2),
          q.y - (q.xy >> 2),
          q.xy >> 1,
          q.xx >> 2,
          q.yy};
}

Axes transposed(const Axes& q) { return {q.value, q.y, q.x, q.xy, q.yy, q.xx}; }

Axes every_second_row(const Axes& q, Siting siting) {
  return transposed(every_second_column(transposed(q), siting));
}

constexpr std::int64_t half_pixel(Siting siting) {
  return siting == Siting::Centred ? kHalfPixel : 0;
}

/// Half of a picture's coordinate; between two pixels' centres if it is centred.
std::int32_t in_source(std::int32_t c, Siting siting) {
  if (siting == Siting::Full) return c;
  return (siting == Siting::Centred ? c - kHalf : c) >> 1;
}

/// Further apart than that, pixels that share one of the plane lie on two sides of an edge.
constexpr std::int32_t kApart = 4 << kFractionBits;

/// The coordinate for `columns` x `rows` pixels from (x, y) on.
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

Patch on_level(const Patch& patch, int level) {
  const Axes& q = patch.axes();
  return Patch(Axes{((q.value + kHalfPixel) >> level) - kHalfPixel, q.x >> level, q.y >> level,
                    q.xy >> level, q.xx >> level, q.yy >> level});
}

void on_level(CoordinateTile& tile, int level) {
  for (CoordinateRow& row : tile) {
    for (Coordinate& c : row) {
      if (is_defined(c)) c = {((c.u + kHalf) >> level) - kHalf, ((c.v + kHalf) >> level) - kHalf};
    }
  }
}

Patch at_half_steps(const Patch& patch) {
  return Patch(transposed(half_steps(transposed(half_steps(patch.axes())))));
}

Patch at_half_rows(const Patch& patch) {
  const Axes& q = patch.axes();
  return Patch(Axes{q.value, q.x, q.y >> 1, q.xy >> 1, q.xx, q.yy >> 2});
}

Patch moved(const Patch& patch, int x, int y) {
  const Axes& q = patch.axes();
  return Patch(Axes{q.value + x * (q.x + x * q.xx + y * q.xy) + y * (q.y + y * q.yy),
                    q.x + 2 * x * q.xx + y * q.xy, q.y + 2 * y * q.yy + x * q.xy, q.xy, q.xx,
                    q.yy});
}

Patch on_plane(const Patch& patch, const PlaneSampling& sampling) {
  Axes q = patch.axes();
  if (sampling.x != Siting::Full) q = every_second_column(q, sampling.x);
  if (sampling.y != Siting::Full) q = every_second_row(q, sampling.y);
  const Both halves{shift(sampling.x), shift(sampling.y)};
  q.value -= Both{half_pixel(sampling.x), half_pixel(sampling.y)};
  return Patch(Axes{q.value >> halves, q.x >> halves, q.y >> halves, q.xy >> halves, q.xx >> halves,
                    q.yy >> halves});
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
