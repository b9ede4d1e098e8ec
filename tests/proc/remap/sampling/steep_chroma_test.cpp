// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/kernel_map.h"
#include "proc/remap/remap.h"
#include "proc/remap/sampling/plane_map.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;
using tests::StoredPicture;

constexpr int kTurnedFrom = 1024;
constexpr int kTurnedWidth = 640, kTurnedHeight = 360;

/// A view that is turned by 45 degrees: in packed 4:2:2, a step to the next pixel of chroma along x
/// is as long as two pixels of the source along its y, where chroma is not subsampled.
struct TurnedScene {
  ViewProjection view =
      ViewProjection::make(
          {ViewKind::Perspective, {110, -30, 45}, 90, {}, kTurnedWidth, kTurnedHeight})
          .value();
  BallProjection ball = BallProjection::make(BallModel::make(BallModel::Kind::Exact, 348.5).value(),
                                             {{511.5, 511.5}, 508, 508, 0}, {})
                            .value();
  CoordinateGrid grid{view, ball, kTurnedFrom, kTurnedFrom};
};

bool fits(const Patch& patch, int columns) {
  constexpr Layout kChroma = Layout::OddOfFour8;
  BlockMap map;
  return map.fit(patch, columns, kTile, BlockMap::rounding(added_u(kChroma), added_v(kChroma)));
}

/// Number of tiles whose chroma fits the kernels' windows in each of these ways.
struct Ways {
  int whole = 0, half_rows = 0, half_columns = 0, both = 0;

  explicit Ways(const CoordinateGrid& grid) {
    const PlaneSampling chroma = samplings(PixelFormat::Yuyv).items[1];
    for (int ty = 0; ty < grid.tiles_y(); ++ty) {
      for (int tx = 0; tx < grid.tiles_x(); ++tx) {
        const Tile tile = grid.tile(tx, ty);
        if (!is_patch(tile.kind) || !tile.interior) continue;
        const Patch patch = on_plane(Patch(grid.nodes(tile, tx, ty)), chroma);
        const Patch rows = at_half_rows(patch), columns = at_half_columns(patch);
        const Patch fine = at_half_rows(columns);
        const auto both_parts = [](const Patch& p, int width) {
          return fits(p, width) && fits(moved(p, 0, kTile), width);
        };
        if (fits(patch, kTile / 2)) {
          ++whole;
        } else if (both_parts(rows, kTile / 2)) {
          ++half_rows;
        } else if (fits(columns, kTile)) {
          ++half_columns;
        } else if (both_parts(fine, kTile)) {
          ++both;
        }
      }
    }
  }
};

/// A triangle wave between 0 and 255, changing by one from pixel to pixel; linear between them.
int wave(int place) {
  const int phase = place % 512;
  return phase < 256 ? phase : 511 - phase;
}
double wave(double place) {
  const int before = static_cast<int>(place);
  return std::lerp(wave(before), wave(before + 1), place - before);
}

// Compares with the exact projection of each chroma sample's place.
TEST(SteepChroma, IsSampledAtItsPlaceByEveryKernel) {
  const TurnedScene scene;
  const Ways ways(scene.grid);
  ASSERT_GT(ways.whole, 50);
  ASSERT_GT(ways.half_rows, 5);
  ASSERT_GT(ways.half_columns, 20);
  ASSERT_GT(ways.both, 2);
  StoredPicture source(PixelFormat::Yuyv, kTurnedFrom, kTurnedFrom);
  for (int y = 0; y < kTurnedFrom; ++y) {
    std::byte* row = source.picture.planes[0].data + y * source.picture.planes[0].stride;
    for (int x = 0; x < kTurnedFrom / 2; ++x) {
      row[4 * x + 1] = static_cast<std::byte>(wave(x));
      row[4 * x + 3] = static_cast<std::byte>(wave(y));
    }
  }
  std::vector<std::byte> first;
  for (const Kernel* kernel : kernels()) {
    SCOPED_TRACE(kernel->name);
    StoredPicture out(PixelFormat::Yuyv, kTurnedWidth, kTurnedHeight, 8);
    remap(scene.grid, source.as_source(), Interpolation::Bilinear, out.picture,
          {0, scene.grid.tiles_y()}, *kernel);
    if (first.empty()) first = out.bytes;
    ASSERT_EQ(out.bytes, first);
  }
  StoredPicture out(PixelFormat::Yuyv, kTurnedWidth, kTurnedHeight, 8);
  out.bytes = first;
  out.picture = MutablePicture::contiguous(PixelFormat::Yuyv, kTurnedWidth, kTurnedHeight,
                                           out.bytes.data(), 2 * kTurnedWidth + 8);
  int compared = 0;
  for (int y = 0; y < kTurnedHeight; ++y) {
    for (int x = 0; x < kTurnedWidth / 2; ++x) {
      const auto direction = scene.view.direction(2 * x, y);
      const auto p = direction ? scene.ball.pixel(*direction) : std::nullopt;
      if (!p || !scene.grid.tile(2 * x / kTile, y / kTile).interior) continue;
      ASSERT_NEAR(out.sample(0, y, 4 * x + 1), wave(p->u / 2), 0.6) << x << ' ' << y;
      ASSERT_NEAR(out.sample(0, y, 4 * x + 3), wave(p->v), 0.6) << x << ' ' << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 10000);
}

}  // namespace
}  // namespace orbwatch::remap
