// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/half_steps.h"

#include <algorithm>
#include <cassert>

// Loops have no branches and rows of known length, so that compilers vectorize them.

namespace orbwatch::remap {
namespace {

/// Longest step within one surface; a longer one leads to another surface.
constexpr std::int32_t kFar = 64 << kFractionBits;

/// Markers surround a tile's pixels: at least one before, and a whole vector behind.
constexpr int kBefore = 4, kWide = kBefore + kTile + 8;

/// Adjacent coordinates, or quarters of steps.
struct Line {
  const std::int32_t *u, *v;
};

/// The same with memory of its own.
struct Row {
  alignas(16) std::int32_t u[kWide], v[kWide];

  Line from(int x) const { return {u + x, v + x}; }
};

constexpr Row marker_row() {
  Row row{};
  for (std::int32_t& u : row.u) u = kBlind;
  return row;
}

/// quarter() and half() round towards zero.
[[gnu::always_inline]] inline std::int32_t quarter(std::int32_t step) {
  return (step + (step >> 31 & 3)) >> 2;
}
[[gnu::always_inline]] inline std::int32_t half(std::int32_t step) {
  return (step + (step >> 31 & 1)) >> 1;
}
/// Difference modulo 2^32: markers are subtracted too.
[[gnu::always_inline]] inline std::int32_t difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
[[gnu::always_inline]] inline bool is_far(std::int32_t step) {
  return static_cast<std::uint32_t>(step) + kFar > std::uint32_t{2 * kFar};
}

/// Quarters of the `count` steps from `from` to `to`; 0 where one is a marker or on another
/// surface.
template <int count>
[[gnu::always_inline]] inline void find_steps(Line from, Line to, Row& steps) {
  for (int x = 0; x < count; ++x) {
    const std::int32_t u = difference(to.u[x], from.u[x]), v = difference(to.v[x], from.v[x]);
    const bool leads_away = (from.u[x] <= kOutside) | (to.u[x] <= kOutside) | is_far(u) | is_far(v);
    steps.u[x] = leads_away ? 0 : quarter(u);
    steps.v[x] = leads_away ? 0 : quarter(v);
  }
}

/// Means of the steps before and behind each pixel.
template <int columns>
[[gnu::always_inline]] inline void find_means(Line before, Line behind, std::int32_t* mean_u,
                                              std::int32_t* mean_v) {
  for (int x = 0; x < columns; ++x) {
    const bool is_one = ((before.u[x] | before.v[x]) == 0) | ((behind.u[x] | behind.v[x]) == 0);
    const std::int32_t u = before.u[x] + behind.u[x], v = before.v[x] + behind.v[x];
    mean_u[x] = is_one ? u : half(u);
    mean_v[x] = is_one ? v : half(v);
  }
}

/// Splits a tile's rows into u and v, and finds the steps within them.
template <int columns, class Pixels>
void find_along_x(const CoordinateTile& tile, int rows, Pixels& here, Pixels& along_x) {
  Row row = marker_row(), steps;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      row.u[kBefore + x] = here.u[y][x] = tile[y][x].u;
      row.v[kBefore + x] = here.v[y][x] = tile[y][x].v;
    }
    find_steps<columns + 4>(row.from(kBefore - 1), row.from(kBefore), steps);
    find_means<columns>(steps.from(0), steps.from(1), along_x.u[y].data(), along_x.v[y].data());
  }
}

template <int columns, class Pixels>
void find_along_y(int rows, const Pixels& here, Pixels& along_y) {
  const Row markers = marker_row();
  Row above{}, below;
  for (int y = 0; y < rows; ++y) {
    const Line next =
        y + 1 < rows ? Line{here.u[y + 1].data(), here.v[y + 1].data()} : markers.from(0);
    find_steps<columns>({here.u[y].data(), here.v[y].data()}, next, below);
    find_means<columns>(above.from(0), below.from(0), along_y.u[y].data(), along_y.v[y].data());
    above = below;
  }
}

/// Locates one axis of a quarter.
[[gnu::always_inline]] inline void locate_axis(const std::int32_t* here,
                                               const std::int32_t* along_x,
                                               const std::int32_t* along_y, std::int32_t* out) {
  for (int x = 0; x < kTile / 2; ++x) {
    const std::int32_t left = here[x] - along_x[x], right = here[x] + along_x[x];
    out[2 * x] = left - along_y[x];
    out[2 * x + 1] = right - along_y[x];
  }
  for (int x = 0; x < kTile / 2; ++x) {
    const std::int32_t left = here[x] - along_x[x], right = here[x] + along_x[x];
    out[kTile + 2 * x] = left + along_y[x];
    out[kTile + 2 * x + 1] = right + along_y[x];
  }
}

}  // namespace

HalfSteps::HalfSteps(const CoordinateTile& tile, int columns, int rows) {
  assert((columns == kTile || columns == kTile / 2) && rows % (kTile / 2) == 0);
  if (columns == kTile) {
    find_along_x<kTile>(tile, rows, here_, along_x_);
    find_along_y<kTile>(rows, here_, along_y_);
  } else {
    find_along_x<kTile / 2>(tile, rows, here_, along_x_);
    find_along_y<kTile / 2>(rows, here_, along_y_);
  }
}

void HalfSteps::locate(int left, int top, Places& quarter) const {
  const int x = left / 2;
  for (int row = 0; row < kTile / 2; ++row) {
    const int y = top / 2 + row;
    const int to = 2 * row * kTile;
    locate_axis(&here_.u[y][x], &along_x_.u[y][x], &along_y_.u[y][x], quarter.u + to);
    locate_axis(&here_.v[y][x], &along_x_.v[y][x], &along_y_.v[y][x], quarter.v + to);
  }
}

}  // namespace orbwatch::remap
