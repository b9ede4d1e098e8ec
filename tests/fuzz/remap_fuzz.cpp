// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "proc/remap/compiler/tolerance.h"
#include "proc/remap/remap.h"
#include "tests/fuzz/fenced_picture.h"
#include "tests/fuzz/remap_scene.h"
#include "tests/fuzz/stop.h"

/// Random grids, sizes and formats: the map keeps to its tolerance, all kernels write the same
/// bytes, and nothing is read or written outside of the pictures.
namespace orbwatch::fuzz {
namespace {

using optics::Vec2;
using remap::Coordinate;
using remap::Interpolation;
using remap::Kernel;

std::string text(const Vec2& p) { return std::to_string(p.u) + ' ' + std::to_string(p.v); }

std::string text(const RemapScene& scene) {
  const remap::CoordinateGrid& grid = scene.grid;
  const auto size = [](int width, int height) {
    return std::to_string(width) + 'x' + std::to_string(height);
  };
  return "view of kind " + std::to_string(static_cast<int>(scene.view.kind())) + ", " +
         size(grid.width(), grid.height()) + ", of a source of " +
         size(grid.source_width(), grid.source_height());
}

std::optional<Vec2> exact(const RemapScene& scene, double x, double y) {
  const auto direction = scene.view.direction(x, y);
  return direction ? scene.ball.pixel(*direction) : std::nullopt;
}

Vec2 place(const Coordinate& c) { return {c.u / remap::kOnePixel, c.v / remap::kOnePixel}; }

double distance(const Vec2& a, const Vec2& b) { return std::hypot(a.u - b.u, a.v - b.v); }

/// True if the map ends or jumps here: double precision does not determine the side that a pixel is
/// on.
bool is_on_an_edge(const RemapScene& scene, int x, int y) {
  constexpr double kBeside = 1e-5;
  const auto here = exact(scene, x, y);
  for (const auto& [dx, dy] : {Vec2{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    const auto there = exact(scene, x + dx * kBeside, y + dy * kBeside);
    if (here.has_value() != there.has_value()) return true;
    if (here && distance(*here, *there) > remap::kTolerance / 2) return true;
  }
  return false;
}

/// Distance of a place from the source picture's border, px; below 0 outside.
double depth(const RemapScene& scene, const Vec2& p) {
  const double right = scene.grid.source_width() - 0.5, bottom = scene.grid.source_height() - 0.5;
  return std::min({p.u + 0.5, p.v + 0.5, right - p.u, bottom - p.v});
}

/// Largest allowed distance of a pixel from the exact map, px of its tile's mip level. The
/// curvature of a map between the grid's nodes is an estimate: of a thousand views, all of them
/// extreme, one has pixels at 1.6 times the tolerance.
constexpr double kFarthest = 3 * remap::kTolerance;

bool agree(const RemapScene& scene, const Coordinate& mine, const std::optional<Vec2>& truth,
           int level) {
  const double farthest = kFarthest * (1 << level);
  if (!remap::is_defined(mine)) return !truth || depth(scene, *truth) < farthest;
  return truth && distance(place(mine), *truth) < farthest && depth(scene, *truth) > -farthest;
}

void check_pixel(const RemapScene& scene, int x, int y) {
  const int tx = x / remap::kTile, ty = y / remap::kTile;
  const Coordinate mine =
      scene.grid.row(tx, ty, y % remap::kTile)[static_cast<std::size_t>(x % remap::kTile)];
  const auto truth = exact(scene, x, y);
  const remap::Tile tile = scene.grid.tile(tx, ty);
  if (agree(scene, mine, truth, tile.level) || is_on_an_edge(scene, x, y)) return;
  stop("pixel " + std::to_string(x) + ' ' + std::to_string(y) + " is " +
       (remap::is_defined(mine) ? "at " + text(place(mine)) : "undefined") + ", not " +
       (truth ? "at " + text(*truth) : "undefined") + "; tile of kind " +
       std::to_string(static_cast<int>(tile.kind)) + "; " + text(scene));
}

void check_grid(const RemapScene& scene, std::uint32_t seed) {
  constexpr int kPixels = 40;
  std::minstd_rand anywhere(seed);
  for (int k = 0; k < kPixels; ++k) {
    check_pixel(scene, static_cast<int>(anywhere() % scene.grid.width()),
                static_cast<int>(anywhere() % scene.grid.height()));
  }
}

/// More samples than any source has.
std::vector<std::byte> make_samples(bool extreme) {
  std::vector<std::byte> samples(std::size_t{kMaxSourceSide} * kMaxSourceSide * 6);
  std::mt19937 random(1);
  for (std::byte& sample : samples) {
    sample = static_cast<std::byte>(extreme ? (random() & 1) * 0xff : random());
  }
  return samples;
}

/// Noise, or only the least and the largest samples.
std::span<const std::byte> samples(bool extreme) {
  static const std::vector<std::byte> noise = make_samples(false), extremes = make_samples(true);
  return extreme ? extremes : noise;
}

/// Input and format of a view.
struct Work {
  const RemapScene& scene;
  std::span<const Picture> source;
  Interpolation interpolation;
  PixelFormat to;
  int padding;
};

/// A view whose bytes are initially `before`.
FencedPicture view_of(const Work& work, const Kernel& kernel, std::byte before) {
  const remap::CoordinateGrid& grid = work.scene.grid;
  FencedPicture out(work.to, grid.width(), grid.height(), work.padding);
  out.fill(before);
  remap::remap(grid, work.source, work.interpolation, out.picture, {0, grid.tiles_y()}, kernel);
  out.for_each_row([&](std::span<std::byte>, std::span<std::byte> padding) {
    if (std::any_of(padding.begin(), padding.end(), [&](std::byte b) { return b != before; })) {
      stop(std::string(kernel.name) + " writes between rows");
    }
  });
  return out;
}

std::vector<std::byte> pixels_of(const FencedPicture& view) {
  std::vector<std::byte> all;
  view.for_each_row([&](std::span<std::byte> pixels, std::span<std::byte>) {
    all.insert(all.end(), pixels.begin(), pixels.end());
  });
  return all;
}

void check_kernels(const Work& work) {
  // Two initial values, so that a byte that no kernel writes is also detected.
  const std::vector<std::byte> expected =
      pixels_of(view_of(work, *remap::kernels().front(), std::byte{0x5a}));
  for (const Kernel* kernel : remap::kernels()) {
    if (pixels_of(view_of(work, *kernel, std::byte{0xa5})) == expected) continue;
    stop(std::string(kernel->name) +
         " differs from scalar: " + std::string(info(work.source.front().format).name) + " to " +
         std::string(info(work.to).name) + "; " + text(work.scene));
  }
}

PixelFormat pick_format(FuzzedDataProvider& bytes) {
  return kPixelFormats[bytes.ConsumeIntegralInRange<std::size_t>(0, kPixelFormats.size() - 1)]
      .format;
}

bool shares_samples(PixelFormat format) { return info(format).colour == ColourModel::Yuv; }

void run(FuzzedDataProvider& bytes) {
  const PixelFormat from = pick_format(bytes);
  PixelFormat to = pick_format(bytes);
  if (!remap::can_remap(from, to)) to = from;
  const auto scene = make_scene(bytes, shares_samples(from));
  if (!scene) return;
  check_grid(*scene, bytes.ConsumeIntegral<std::uint16_t>());

  const remap::CoordinateGrid& grid = scene->grid;
  FencedPicture source(from, grid.source_width(), grid.source_height(),
                       bytes.ConsumeIntegralInRange(0, 40));
  source.fill(samples(bytes.ConsumeBool()));
  source.picture.colour_space = {static_cast<ColourMatrix>(bytes.ConsumeBool()),
                                 static_cast<ColourRange>(bytes.ConsumeBool())};
  source.forbid_padding();
  remap::Pyramid pyramid(from, grid.source_width(), grid.source_height(),
                         bytes.ConsumeBool() ? grid.pyramid_levels() : 0);
  pyramid.set_source(source.picture);
  pyramid.fill();
  const auto interpolation = static_cast<Interpolation>(bytes.ConsumeIntegralInRange(0, 2));
  check_kernels(
      {*scene, pyramid.pictures(), interpolation, to, bytes.ConsumeIntegralInRange(0, 40)});
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  orbwatch::fuzz::run(bytes);
  return 0;
}
