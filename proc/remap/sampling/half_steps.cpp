#include "proc/remap/sampling/half_steps.h"

#include <algorithm>
#include <cassert>

// In loops without branches, over rows of known length, which compilers vectorize.

namespace orbwatch::remap {
namespace {

/// Steps further than that lead to another surface.
constexpr std::int32_t kFar = 64 << kFractionBits;

/// Beyond a tile's pixels are markers: at least one before, and one behind a whole vector.
constexpr int kBefore = 4, kWide = kBefore + kTile + 8;

/// A row of coordinates, or of quarters of steps.
struct Row {
  alignas(16) std::int32_t u[kWide], v[kWide];
};

constexpr Row marker_row() {
  Row row{};
  for (std::int32_t& u : row.u) u = kBlind;
  return row;
}

/// Rounded towards zero.
[[gnu::always_inline]] inline std::int32_t quarter(std::int32_t step) {
  return (step + (step >> 31 & 3)) >> 2;
}
[[gnu::always_inline]] inline std::int32_t half(std::int32_t step) {
  return (step + (step >> 31 & 1)) >> 1;
}
/// Modulo 2^32: markers are subtracted too.
[[gnu::always_inline]] inline std::int32_t difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
[[gnu::always_inline]] inline bool is_far(std::int32_t step) {
  return static_cast<std::uint32_t>(step) + kFar > std::uint32_t{2 * kFar};
}

/// Quarters of the `count` steps from `from` to `to`; 0 where one is a marker or on another
/// surface.
template <int count>
[[gnu::always_inline]] inline void find_steps(const std::int32_t* from_u,
                                              const std::int32_t* from_v, const std::int32_t* to_u,
                                              const std::int32_t* to_v, Row& steps) {
  for (int x = 0; x < count; ++x) {
    const std::int32_t u = difference(to_u[x], from_u[x]), v = difference(to_v[x], from_v[x]);
    const bool leads_away = (from_u[x] <= kOutside) | (to_u[x] <= kOutside) | is_far(u) | is_far(v);
    steps.u[x] = leads_away ? 0 : quarter(u);
    steps.v[x] = leads_away ? 0 : quarter(v);
  }
}

/// Of the steps before and behind each pixel.
template <int columns>
[[gnu::always_inline]] inline void find_means(const std::int32_t* before_u,
                                              const std::int32_t* before_v,
                                              const std::int32_t* behind_u,
                                              const std::int32_t* behind_v, std::int32_t* mean_u,
                                              std::int32_t* mean_v) {
  for (int x = 0; x < columns; ++x) {
    const bool is_one = ((before_u[x] | before_v[x]) == 0) | ((behind_u[x] | behind_v[x]) == 0);
    const std::int32_t u = before_u[x] + behind_u[x], v = before_v[x] + behind_v[x];
    mean_u[x] = is_one ? u : half(u);
    mean_v[x] = is_one ? v : half(v);
  }
}

/// Row by row, `columns` wide.
template <int columns, class Pixels>
void find(const CoordinateTile& tile, int rows, Pixels& here, Pixels& along_x, Pixels& along_y) {
  Row markers = marker_row(), row = markers, steps, above, below;
  find_steps<columns>(markers.u, markers.v, markers.u, markers.v, above);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      row.u[kBefore + x] = here.u[y][x] = tile[y][x].u;
      row.v[kBefore + x] = here.v[y][x] = tile[y][x].v;
    }
    constexpr int kFirst = kBefore - 1;
    find_steps<columns + 4>(row.u + kFirst, row.v + kFirst, row.u + kBefore, row.v + kBefore,
                            steps);
    find_means<columns>(steps.u, steps.v, steps.u + 1, steps.v + 1, along_x.u[y].data(),
                        along_x.v[y].data());
  }
  for (int y = 0; y < rows; ++y) {
    const int next = y + 1;
    const std::int32_t* const next_u = next < rows ? here.u[next].data() : markers.u;
    const std::int32_t* const next_v = next < rows ? here.v[next].data() : markers.v;
    find_steps<columns>(here.u[y].data(), here.v[y].data(), next_u, next_v, below);
    find_means<columns>(above.u, above.v, below.u, below.v, along_y.u[y].data(),
                        along_y.v[y].data());
    above = below;
  }
}

/// One axis of a quarter.
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
  columns == kTile ? find<kTile>(tile, rows, here_, along_x_, along_y_)
                   : find<kTile / 2>(tile, rows, here_, along_x_, along_y_);
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
