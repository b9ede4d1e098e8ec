// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/remap.h"
#include "proc/remap/sampling/pyramid.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;
using tests::StoredPicture;

/// A view of a ball that fills a picture of `width` x `height`, including the limb and the
/// picture's border.
struct BallScene {
  BallScene(int width, int height, const optics::ViewSpec& spec)
      : view(ViewProjection::make(spec).value()),
        ball(BallProjection::make(BallModel::make(BallModel::Kind::Exact, 340).value(),
                                  {{width / 2.0, height / 2.0}, width * 0.49, width * 0.49, 0}, {})
                 .value()),
        grid(view, ball, width, height) {}

  ViewProjection view;
  BallProjection ball;
  CoordinateGrid grid;
};

/// Compares every kernel's view with the scalar one's, byte for byte, padding included.
void expect_same(const BallScene& scene, PixelFormat format, PixelFormat to, int padding) {
  StoredPicture source(format, scene.grid.source_width(), scene.grid.source_height(), padding);
  source.fill_with_noise(3);
  Pyramid pyramid(format, source.picture.width, source.picture.height, scene.grid.pyramid_levels());
  pyramid.set_source(source.picture);
  pyramid.fill();
  std::vector<std::byte> expected;
  for (const Kernel* kernel : kernels()) {
    StoredPicture out(to, scene.grid.width(), scene.grid.height(), padding);
    remap(scene.grid, pyramid.pictures(), Interpolation::Area, out.picture,
          {0, scene.grid.tiles_y()}, *kernel);
    if (expected.empty()) expected = out.bytes;
    ASSERT_EQ(out.bytes, expected) << kernel->name << ": " << info(format).name << " to "
                                   << info(to).name << ", " << scene.grid.width() << " wide";
  }
}

constexpr int even(int side) { return (side + 1) / 2 * 2; }

TEST(RemapKernels, AgreeForEveryFormat) {
  const BallScene scene(400, 320, {ViewKind::Perspective, {60, 20, 30}, 120, {}, 150, 90});
  const BallScene small(400, 320, {ViewKind::Perspective, {20, 20, 30}, 90, {}, 64, 48});
  for (const PixelFormatInfo& format : kPixelFormats) {
    for (const PixelFormat to : {format.format, PixelFormat::Rgb, PixelFormat::Bgr}) {
      if (!can_remap(format.format, to)) continue;
      expect_same(scene, format.format, to, 12);
      expect_same(small, format.format, to, 0);
    }
  }
}

TEST(RemapKernels, AgreeForEveryWidth) {
  for (int width = 1; width <= 129; ++width) {
    const int height = 1 + width * 7 % 40;
    const BallScene scene(200, 200, {ViewKind::Perspective, {30, -10, 15}, 70, {}, width, height});
    expect_same(scene, PixelFormat::Grey, PixelFormat::Grey, width % 5);
    expect_same(scene, PixelFormat::Rgb, PixelFormat::Rgb, width % 7);
    expect_same(scene, PixelFormat::Y16, PixelFormat::Y16, 2 * (width % 3));
    const BallScene both_even(
        200, 200, {ViewKind::Perspective, {30, -10, 15}, 70, {}, even(width), even(height)});
    expect_same(both_even, PixelFormat::Nv12, PixelFormat::Nv12, 2 * (width % 3));
    expect_same(both_even, PixelFormat::Yuyv, PixelFormat::Yuyv, 2 * (width % 3));
    expect_same(scene, PixelFormat::Uyvy, PixelFormat::Bgr, width % 5);
  }
}

TEST(RemapKernels, AgreeForSourcesOfEverySize) {
  for (const int side : {16, 18, 32, 50, 130, 514, 2000}) {
    for (const double yaw : {0.0, 90.0, 170.0}) {
      const BallScene scene(side, side, {ViewKind::Perspective, {yaw, 15, 40}, 100, {}, 80, 64});
      expect_same(scene, PixelFormat::Grey, PixelFormat::Grey, 0);
      expect_same(scene, PixelFormat::Nv12, PixelFormat::Rgb, 0);
      expect_same(scene, PixelFormat::Y16, PixelFormat::Y16, 0);
    }
  }
  const BallScene large(8192, 8192, {ViewKind::Perspective, {10, 15, 40}, 12, {}, 160, 96});
  expect_same(large, PixelFormat::Grey, PixelFormat::Grey, 0);
}

/// All directions around a ball, where the map gets steeper and more curved towards the limb. Its
/// tiles use every kind of storage for one surface.
BallScene all_around() {
  return {800, 800, {ViewKind::Equirectangular, {10, 20, 5}, {}, {}, 1400, 700}};
}

void expect_kinds(const CoordinateGrid& grid) {
  std::set<TileKind> kinds;
  bool border = false;
  for (int ty = 0; ty < grid.tiles_y(); ++ty) {
    for (int tx = 0; tx < grid.tiles_x(); ++tx) {
      const Tile tile = grid.tile(tx, ty);
      kinds.insert(tile.kind);
      border = border || (tile.kind >= TileKind::Curved && !tile.interior);
    }
  }
  for (const TileKind kind :
       {TileKind::Curved, TileKind::Fine, TileKind::CurvedFine, TileKind::Pixels}) {
    EXPECT_EQ(kinds.count(kind), 1U) << static_cast<int>(kind);
  }
  EXPECT_TRUE(border);
}

TEST(RemapKernels, AgreeForEveryKindOfTile) {
  const BallScene scene = all_around();
  expect_kinds(scene.grid);
  for (const PixelFormat format : {PixelFormat::Grey, PixelFormat::Nv12, PixelFormat::Yuyv,
                                   PixelFormat::Bgr, PixelFormat::Y16}) {
    expect_same(scene, format, format, 4);
  }
}

/// Compares the places of a view's samples, if the source is a ramp of 64 per pixel along an axis.
void expect_exact(const BallScene& scene, double optics::Vec2::*axis, const Kernel& kernel) {
  constexpr int kPerPixel = 64;
  StoredPicture source(PixelFormat::Y16, scene.grid.source_width(), scene.grid.source_height());
  const auto samples = source.picture.samples<std::uint16_t>();
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      const int place = axis == &optics::Vec2::u ? x : y;
      samples.row(y)[x] = static_cast<std::uint16_t>(kPerPixel * place);
    }
  }
  StoredPicture out(PixelFormat::Y16, scene.grid.width(), scene.grid.height());
  remap(scene.grid, source.as_source(), Interpolation::Bilinear, out.picture,
        {0, scene.grid.tiles_y()}, kernel);
  // The sum of the tolerances of places in lanes, of weights, and of samples; then of the grid.
  constexpr double kInKernel = 1.0 / 240 + 1.0 / 256 + 0.5 / kPerPixel;
  const auto tolerated = [&](int x, int y) {
    return kInKernel + kTolerance * (1 << scene.grid.tile(x / kTile, y / kTile).level);
  };
  int compared = 0;
  for (int y = 0; y < out.picture.height; ++y) {
    for (int x = 0; x < out.picture.width; ++x) {
      const auto direction = scene.view.direction(x, y);
      const auto truth = direction ? scene.ball.pixel(*direction) : std::nullopt;
      if (!truth) continue;
      const double there = out.picture.samples<std::uint16_t>().row(y)[x] / double{kPerPixel};
      ASSERT_NEAR(there, (*truth).*axis, tolerated(x, y)) << kernel.name << ' ' << x << ' ' << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 900000);
}

TEST(RemapKernels, FollowTheExactMapInEveryStore) {
  const BallScene scene = all_around();
  for (const Kernel* kernel : kernels()) {
    expect_exact(scene, &optics::Vec2::u, *kernel);
    expect_exact(scene, &optics::Vec2::v, *kernel);
  }
}

}  // namespace
}  // namespace orbwatch::remap
