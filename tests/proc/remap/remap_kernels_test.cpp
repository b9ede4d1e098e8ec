#include <gtest/gtest.h>

#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/pyramid.h"
#include "proc/remap/remap.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;
using tests::StoredPicture;

/// A view of a ball that fills a picture of `width` x `height`: the limb and the picture's border
/// are in it.
struct Scene {
  Scene(int width, int height, const optics::ViewSpec& spec)
      : view(ViewProjection::make(spec).value()),
        ball(BallProjection::make(BallModel::exact(340).value(),
                                  {{width / 2.0, height / 2.0}, width * 0.49, width * 0.49, 0}, {})
                 .value()),
        grid(view, ball, width, height) {}

  ViewProjection view;
  BallProjection ball;
  CoordinateGrid grid;
};

/// Every kernel's view beside the scalar one's, byte for byte, padding included.
void expect_same(const Scene& scene, PixelFormat format, PixelFormat to, int padding) {
  StoredPicture source(format, scene.grid.source_width(), scene.grid.source_height(), padding);
  source.fill_with_noise(3);
  Pyramid pyramid(format, source.picture.width, source.picture.height, scene.grid.halves());
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
  const Scene scene(400, 320, {ViewKind::Perspective, {60, 20, 30}, 120, {}, 150, 90});
  const Scene small(400, 320, {ViewKind::Perspective, {20, 20, 30}, 90, {}, 64, 48});
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
    const Scene scene(200, 200, {ViewKind::Perspective, {30, -10, 15}, 70, {}, width, height});
    expect_same(scene, PixelFormat::Grey, PixelFormat::Grey, width % 5);
    expect_same(scene, PixelFormat::Rgb, PixelFormat::Rgb, width % 7);
    expect_same(scene, PixelFormat::Y16, PixelFormat::Y16, 2 * (width % 3));
    const Scene both_even(
        200, 200, {ViewKind::Perspective, {30, -10, 15}, 70, {}, even(width), even(height)});
    expect_same(both_even, PixelFormat::Nv12, PixelFormat::Nv12, 2 * (width % 3));
    expect_same(both_even, PixelFormat::Yuyv, PixelFormat::Yuyv, 2 * (width % 3));
    expect_same(scene, PixelFormat::Uyvy, PixelFormat::Bgr, width % 5);
  }
}

TEST(RemapKernels, AgreeForSourcesOfEverySize) {
  for (const int side : {16, 18, 32, 50, 130, 514, 2000}) {
    for (const double yaw : {0.0, 90.0, 170.0}) {
      const Scene scene(side, side, {ViewKind::Perspective, {yaw, 15, 40}, 100, {}, 80, 64});
      expect_same(scene, PixelFormat::Grey, PixelFormat::Grey, 0);
      expect_same(scene, PixelFormat::Nv12, PixelFormat::Rgb, 0);
      expect_same(scene, PixelFormat::Y16, PixelFormat::Y16, 0);
    }
  }
  const Scene large(8192, 8192, {ViewKind::Perspective, {10, 15, 40}, 12, {}, 160, 96});
  expect_same(large, PixelFormat::Grey, PixelFormat::Grey, 0);
}

}  // namespace
}  // namespace orbwatch::remap
