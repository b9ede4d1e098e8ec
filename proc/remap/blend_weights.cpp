#include "proc/remap/blend_weights.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "proc/optics/resolution.h"
#include "proc/remap/merge.h"

namespace orbwatch::remap {
namespace {

/// Width of the fading border as a share of the source picture's shorter side.
constexpr double kFeather = 1.0 / 16;

/// What a pixel counts at least where a source sees it: far below any other merit.
constexpr double kLeastMerit = std::numeric_limits<double>::min();

double fourth_power(double x) { return (x * x) * (x * x); }

/// 0 at t <= 0, 1 at t >= 1, without a kink in between.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// What one source offers, before the sources are weighed against each other.
class Merit {
 public:
  Merit(const optics::ViewProjection& view, const BlendSource& source)
      : grid_(source.grid), weight_(source.weight) {
    nodes_.reserve(static_cast<std::size_t>(grid_.tiles_x() + 1) * (grid_.tiles_y() + 1));
    for (int j = 0; j <= grid_.tiles_y(); ++j) {
      for (int i = 0; i <= grid_.tiles_x(); ++i) {
        const auto direction = view.direction(i * kTile, j * kTile);
        const double resolution = direction ? optics::resolution(source.ball, *direction) : 0;
        nodes_.push_back(source.enough ? std::min(1.0, resolution / *source.enough) : resolution);
      }
    }
  }

  /// Row `y` of the view into `merits`: 0 where the source sees nothing, above 0 where it sees.
  void row(int y, double* merits) const {
    for (int tx = 0; tx < grid_.tiles_x(); ++tx) {
      const int columns = std::min(kTile, grid_.width() - tx * kTile);
      tile_row(tx, y, columns, merits + static_cast<std::ptrdiff_t>(tx) * kTile);
    }
  }

 private:
  void tile_row(int tx, int y, int columns, double* merits) const {
    const CoordinateRow coordinates = grid_.row(tx, y / kTile, y % kTile);
    const auto [left, step] = resolution(tx, y);
    for (int x = 0; x < columns; ++x) {
      const Coordinate& c = coordinates[x];
      const double merit = weight_ * fourth_power(left + x * step) * feather(c);
      merits[x] = is_defined(c) ? std::max(kLeastMerit, merit) : 0;
    }
  }

  struct Line {
    double left;
    double step;
  };
  /// Pixels per degree, or their share of enough, along a row of a tile between its corners.
  Line resolution(int tx, int y) const {
    const auto node = [&](int i, int j) {
      return nodes_[static_cast<std::size_t>(j) * (grid_.tiles_x() + 1) + i];
    };
    const int ty = y / kTile;
    const double below = (y % kTile) / double{kTile};
    const double left = std::lerp(node(tx, ty), node(tx, ty + 1), below);
    const double right = std::lerp(node(tx + 1, ty), node(tx + 1, ty + 1), below);
    return {left, (right - left) / kTile};
  }

  /// 1 within the source picture, falling to 0 at its border.
  double feather(const Coordinate& c) const {
    const int width = grid_.source_width(), height = grid_.source_height();
    constexpr double kPixel = 1.0 / (1 << kFractionBits);
    const double u = c.u * kPixel + 0.5, v = c.v * kPixel + 0.5;
    const double inside = std::min({u, width - u, v, height - v});
    return smooth_step(inside / (kFeather * std::min(width, height)));
  }

  const CoordinateGrid& grid_;
  double weight_;
  std::vector<double> nodes_;
};

std::uint8_t share(double merit, double total) {
  if (!(merit > 0)) return 0;
  return static_cast<std::uint8_t>(std::max(1L, std::lround(merit / total * UINT8_MAX)));
}

}  // namespace

std::vector<std::vector<std::uint8_t>> blend_weights(const optics::ViewProjection& view,
                                                     std::span<const BlendSource> sources) {
  assert(sources.size() <= kMaxSources);
  const auto width = static_cast<std::size_t>(view.width());
  std::vector<Merit> merits;
  for (const BlendSource& source : sources) merits.emplace_back(view, source);
  std::vector<std::vector<std::uint8_t>> planes(
      sources.size(), std::vector<std::uint8_t>(width * static_cast<std::size_t>(view.height())));
  std::array<std::vector<double>, kMaxSources> row;
  for (auto& values : row) values.resize(width);
  for (int y = 0; y < view.height(); ++y) {
    for (std::size_t n = 0; n < merits.size(); ++n) merits[n].row(y, row[n].data());
    for (std::size_t x = 0; x < width; ++x) {
      double total = 0;
      for (std::size_t n = 0; n < merits.size(); ++n) total += row[n][x];
      for (std::size_t n = 0; n < merits.size(); ++n) {
        planes[n][static_cast<std::size_t>(y) * width + x] = share(row[n][x], total);
      }
    }
  }
  return planes;
}

}  // namespace orbwatch::remap
