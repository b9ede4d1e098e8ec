// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/compiler/plain_tiles.h"

#include <algorithm>
#include <cmath>

#include "proc/remap/compiler/mip_level.h"
#include "proc/remap/compiler/tolerance.h"
#include "proc/remap/grid/patch.h"

namespace orbwatch::remap {
namespace {

constexpr std::size_t kRun = PlainTiles::kRun;
using Floats = std::array<float, kRun>;

// Rounding in Q13 pixels: a float holds coordinates up to 2^27 with an error of 8 at most.
constexpr float kRounding = 16;

/// Measures of one axis of a run of tiles, in Q13 pixels.
struct Axis {
  Floats third;     ///< error of third order
  Floats fourth_x;  ///< fourth differences along x and y
  Floats fourth_y;
  Floats low;  ///< bounds of all pixels
  Floats high;
  Floats along_x, along_y;  ///< twice the tile's extent in its middle
  Floats span;              ///< bound of the distance between neighbouring nodes
};

/// `nodes`: node of the first tile's corner. Undefined nodes have undefined results; differences
/// wrap around.
void measure(const std::int32_t* nodes, std::ptrdiff_t stride, Axis& axis) {
  constexpr auto kThird = static_cast<float>(kThirdDifference);
  // Factor for the sum of both sides' changes, where third_order_error() uses the mean.
  constexpr auto kAcross = static_cast<float>(kChangeAcross / 2);
  for (std::size_t k = 0; k < kRun; ++k) {
    const auto n = [&](int i, int j) {
      return static_cast<std::uint32_t>(nodes[static_cast<std::ptrdiff_t>(k) + i + j * stride]);
    };
    const auto real = [](std::uint32_t difference) {
      return static_cast<float>(static_cast<std::int32_t>(difference));
    };
    const auto xx = [&](int i, int j) { return n(i - 1, j) - 2 * n(i, j) + n(i + 1, j); };
    const auto yy = [&](int i, int j) { return n(i, j - 1) - 2 * n(i, j) + n(i, j + 1); };
    const std::uint32_t xx00 = xx(0, 0), xx10 = xx(1, 0), xx01 = xx(0, 1), xx11 = xx(1, 1);
    const std::uint32_t yy00 = yy(0, 0), yy10 = yy(1, 0), yy01 = yy(0, 1), yy11 = yy(1, 1);
    const float x0 = std::abs(real(xx10 - xx00)), x1 = std::abs(real(xx11 - xx01));
    const float y0 = std::abs(real(yy01 - yy00)), y1 = std::abs(real(yy11 - yy10));
    const float across_x = std::abs(real(yy10 + yy11 - yy00 - yy01));
    const float across_y = std::abs(real(xx01 + xx11 - xx00 - xx10));
    axis.third[k] =
        kThird * (std::max(x0, x1) + std::max(y0, y1)) + kAcross * (across_x + across_y);
    axis.fourth_x[k] = real(n(-2, 0) - 4 * n(-1, 0) + 6 * n(0, 0) - 4 * n(1, 0) + n(2, 0));
    axis.fourth_y[k] = real(n(0, -2) - 4 * n(0, -1) + 6 * n(0, 0) - 4 * n(0, 1) + n(0, 2));
    // A patch bulges between the corners by an eighth of the mean second differences.
    const float bulge =
        (std::abs(real(xx00 + xx10 + xx01 + xx11)) + std::abs(real(yy00 + yy10 + yy01 + yy11))) /
        32;
    const float a = real(n(0, 0)), b = real(n(1, 0)), c = real(n(0, 1)), d = real(n(1, 1));
    axis.low[k] = std::min(std::min(a, b), std::min(c, d)) - bulge - kRounding;
    axis.high[k] = std::max(std::max(a, b), std::max(c, d)) + bulge + kRounding;
    // Each node outwards from a corner adds one second difference; 32 bulges are four of them.
    axis.span[k] = axis.high[k] - axis.low[k] + 32 * bulge;
    axis.along_x[k] = real(n(1, 0) - n(0, 0) + n(1, 1) - n(0, 1));
    axis.along_y[k] = real(n(0, 1) - n(0, 0) + n(1, 1) - n(1, 0));
  }
}

float hypotenuse(float a, float b) { return std::sqrt(a * a + b * b); }

}  // namespace

PlainTiles::PlainTiles(int tiles_x, int tiles_y, int source_width, int source_height)
    : tiles_x_(tiles_x),
      tiles_y_(tiles_y),
      width_(static_cast<float>(source_width)),
      height_(static_cast<float>(source_height)),
      stride_((static_cast<std::size_t>(tiles_x) + kRun - 1) / kRun * kRun + 5) {
  const std::size_t count = index(-2, std::max(tiles_y, 2) + 2);
  for (auto* plane : {&u_, &v_, &surfaces_}) plane->resize(count);
}

void PlainTiles::finish() {
  extrapolate(u_);
  extrapolate(v_);
}

/// Extends by one node before the first row and column, with the fourth difference of the first
/// five nodes.
void PlainTiles::extrapolate(std::vector<std::int32_t>& plane) const {
  const auto before = [&plane](std::size_t at, std::size_t step) {
    const auto n = [&](std::size_t i) { return static_cast<std::uint32_t>(plane[at + i * step]); };
    plane[at] = static_cast<std::int32_t>(5 * n(1) - 10 * n(2) + 10 * n(3) - 5 * n(4) + n(5));
  };
  for (int j = -1; j <= tiles_y_ + 1; ++j) before(index(-2, j), 1);
  for (int i = -1; i <= tiles_x_ + 1; ++i) before(index(i, -2), stride_);
}

void PlainTiles::classify(int tx, int ty, Levels& levels) const {
  const std::size_t at = index(tx, ty);
  const auto stride = static_cast<std::ptrdiff_t>(stride_);
  Axis u, v;
  measure(&u_[at], stride, u);
  measure(&v_[at], stride, v);
  std::array<std::int32_t, kRun> differ;
  const std::int32_t* surfaces = &surfaces_[at];
  for (std::size_t k = 0; k < kRun; ++k) {
    const std::int32_t* s = surfaces + k;
    const auto row = [&](std::ptrdiff_t j) { return s + j * stride; };
    differ[k] = (s[-1] ^ s[0]) | (s[1] ^ s[0]) | (s[2] ^ s[0]) | (row(1)[-1] ^ s[0]) |
                (row(1)[0] ^ s[0]) | (row(1)[1] ^ s[0]) | (row(1)[2] ^ s[0]) | (row(-1)[0] ^ s[0]) |
                (row(-1)[1] ^ s[0]) | (row(2)[0] ^ s[0]) | (row(2)[1] ^ s[0]);
  }
  const float width = width_, height = height_;
  for (std::size_t k = 0; k < kRun; ++k) {
    constexpr auto kOne = static_cast<float>(kOnePixel);
    constexpr auto kFourth = static_cast<float>(kFourthOrder);
    constexpr float kSpan = kSteepest * kTile * kOne;
    const float error =
        hypotenuse(u.third[k], v.third[k]) + kFourth * (hypotenuse(u.fourth_x[k], v.fourth_x[k]) +
                                                        hypotenuse(u.fourth_y[k], v.fourth_y[k]));
    constexpr float kExtent = 2 * kTile * kOne;
    const float x2 = u.along_x[k] * u.along_x[k] + v.along_x[k] * v.along_x[k];
    const float y2 = u.along_y[k] * u.along_y[k] + v.along_y[k] * v.along_y[k];
    const float step2 = std::max(x2, y2) * (1 / (kExtent * kExtent));
    const std::int32_t level = level_of_step2(step2);
    const float factor = scale_of_step2(step2), scale = factor * kOne;
    const float before = kInteriorBefore * scale, beyond = kInteriorBeyond * scale;
    const float high_u = width * kOne - beyond, high_v = height * kOne - beyond;
    const bool plain = (error < static_cast<float>(kClose) * factor) & (differ[k] == 0) &
                       (u.low[k] >= before) & (v.low[k] >= before) & (u.high[k] <= high_u) &
                       (v.high[k] <= high_v) & (u.span[k] <= kSpan) & (v.span[k] <= kSpan);
    levels[k] = plain ? level : kNotPlain;
  }
}

}  // namespace orbwatch::remap
