#include "proc/remap/plane_map.h"

#include <cstdlib>

namespace orbwatch::remap {
namespace {

constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
constexpr std::int64_t kHalfPixel = std::int64_t{kHalf} << PatchRow::kScaleBits;

/// X -> 2 X, or 2 X + 1/2.
Quadratic every_second_column(const Quadratic& q, Siting siting) {
  Quadratic out{q.value, 2 * q.x, q.y, 2 * q.xy, 4 * q.xx, q.yy};
  if (siting == Siting::Centred) {
    out.value += (2 * q.x + q.xx) >> 2;
    out.x += 2 * q.xx;
    out.y += q.xy >> 1;
  }
  return out;
}

/// X -> X / 2 - 1/4
Quadratic half_steps(const Quadratic& q) {
  return {q.value - (q.x >> 2) + (q.xx >> 4),
          (q.x >> 1) - (q.xx >> 2),
          q.y - (q.xy >> 2),
          q.xy >> 1,
          q.xx >> 2,
          q.yy};
}

Quadratic moved(const Quadratic& q, int x, int y) {
  return {q.value + x * (q.x + x * q.xx + y * q.xy) + y * (q.y + y * q.yy),
          q.x + 2 * x * q.xx + y * q.xy,
          q.y + 2 * y * q.yy + x * q.xy,
          q.xy,
          q.xx,
          q.yy};
}

Quadratic transposed(const Quadratic& q) { return {q.value, q.y, q.x, q.xy, q.yy, q.xx}; }

Quadratic every_second_row(const Quadratic& q, Siting siting) {
  return transposed(every_second_column(transposed(q), siting));
}

/// Half of a picture's coordinate; between two pixels' centres if it is centred.
template <class Integer>
Integer halved(Integer coordinate, Siting siting, Integer half_pixel) {
  return (siting == Siting::Centred ? coordinate - half_pixel : coordinate) >> 1;
}

Quadratic in_source(const Quadratic& q, Siting siting) {
  if (siting == Siting::Full) return q;
  return {halved(q.value, siting, kHalfPixel), q.x >> 1, q.y >> 1, q.xy >> 1, q.xx >> 1, q.yy >> 1};
}

Coordinate in_source(Coordinate c, const PlaneSampling& sampling) {
  if (sampling.x != Siting::Full) c.u = halved(c.u, sampling.x, kHalf);
  if (sampling.y != Siting::Full) c.v = halved(c.v, sampling.y, kHalf);
  return c;
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
  const auto axis = [level](const Quadratic& q) {
    return Quadratic{((q.value + kHalfPixel) >> level) - kHalfPixel,
                     q.x >> level,
                     q.y >> level,
                     q.xy >> level,
                     q.xx >> level,
                     q.yy >> level};
  };
  return {axis(patch.u()), axis(patch.v())};
}

void on_level(CoordinateTile& tile, int level) {
  for (CoordinateRow& row : tile) {
    for (Coordinate& c : row) {
      if (is_defined(c)) c = {((c.u + kHalf) >> level) - kHalf, ((c.v + kHalf) >> level) - kHalf};
    }
  }
}

Patch at_half_steps(const Patch& patch) {
  const auto axis = [](const Quadratic& q) {
    return transposed(half_steps(transposed(half_steps(q))));
  };
  return {axis(patch.u()), axis(patch.v())};
}

Patch at_half_rows(const Patch& patch) {
  const auto axis = [](const Quadratic& q) {
    return Quadratic{q.value, q.x, q.y >> 1, q.xy >> 1, q.xx, q.yy >> 2};
  };
  return {axis(patch.u()), axis(patch.v())};
}

Patch moved(const Patch& patch, int x, int y) {
  return {moved(patch.u(), x, y), moved(patch.v(), x, y)};
}

Patch on_plane(const Patch& patch, const PlaneSampling& sampling) {
  const auto axis = [&](Quadratic q, Siting along) {
    if (sampling.x != Siting::Full) q = every_second_column(q, sampling.x);
    if (sampling.y != Siting::Full) q = every_second_row(q, sampling.y);
    return in_source(q, along);
  };
  return {axis(patch.u(), sampling.x), axis(patch.v(), sampling.y)};
}

void on_plane(const CoordinateTile& picture, const PlaneSampling& sampling, CoordinateTile& plane) {
  const int columns = 1 << shift(sampling.x), rows = 1 << shift(sampling.y);
  const bool centred = sampling.x == Siting::Centred || sampling.y == Siting::Centred;
  for (int y = 0; y < kTile / rows; ++y) {
    for (int x = 0; x < kTile / columns; ++x) {
      const Coordinate c = shared(picture, x * columns, y * rows, columns, rows, centred);
      plane[y][x] = is_defined(c) ? in_source(c, sampling) : c;
    }
  }
}

}  // namespace orbwatch::remap
