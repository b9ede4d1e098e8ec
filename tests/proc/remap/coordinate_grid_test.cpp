#include "proc/remap/coordinate_grid.h"

#include <gtest/gtest.h>

#include <random>

#include "proc/optics/rotation.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;

constexpr double kOne = 1 << kFractionBits;

struct Found {
  double worst = 0;         ///< largest distance of a defined pixel from the exact map, px
  int wrongly_defined = 0;  ///< pixels whose definedness differs
  int dense_tiles = 0;
};

Coordinate coordinate(const CoordinateGrid& grid, int x, int y) {
  const int tx = x / kTile, ty = y / kTile;
  const Tile& tile = grid.tile(tx, ty);
  if (tile.kind == TileClass::Blind) return {kBlind, 0};
  if (tile.kind == TileClass::Outside) return {kOutside, 0};
  if (tile.kind == TileClass::Dense) return grid.dense_row(tile, y % kTile)[x % kTile];
  PatchRow row = grid.patch_row(tx, ty, y % kTile);
  for (int i = 0; i < x % kTile; ++i) row.step();
  return row.current();
}

Found compare(const CoordinateGrid& grid, const ViewProjection& view, const BallProjection& ball) {
  Found found;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      const Coordinate mine = coordinate(grid, x, y);
      const auto truth = ball.pixel(view.direction(x, y));
      const bool in_picture = truth && truth->u >= -0.5 && truth->u <= grid.source_width() - 0.5 &&
                              truth->v >= -0.5 && truth->v <= grid.source_height() - 0.5;
      if (is_defined(mine) != in_picture) {
        ++found.wrongly_defined;
      } else if (in_picture) {
        found.worst = std::max(found.worst, std::hypot(mine.u / kOne - truth->u,  //
                                                       mine.v / kOne - truth->v));
      }
    }
  }
  for (int ty = 0; ty < grid.tiles_y(); ++ty) {
    for (int tx = 0; tx < grid.tiles_x(); ++tx) {
      found.dense_tiles += grid.tile(tx, ty).kind == TileClass::Dense;
    }
  }
  return found;
}

BallProjection centred_ball(const BallModel& model, double size, double radius) {
  return BallProjection::make(model, {{(size - 1) / 2, (size - 1) / 2}, radius, radius, 0}, {})
      .value();
}

TEST(CoordinateGrid, IsExactToASixtyFourthOfAPixel) {
  const std::array models{BallModel::exact(348.5).value(), BallModel::exact(300).value(),
                          BallModel::exact(360).value(), BallModel::paper(346).value(),
                          BallModel::classical()};
  const std::array<std::array<double, 4>, 7> views{{{0, 0, 0, 90},
                                                    {40, 20, 10, 90},
                                                    {110, -30, 45, 90},
                                                    {180, 0, 0, 90},
                                                    {170, 60, 30, 120},
                                                    {10, 0, 0, 5},
                                                    {-90, -90, 0, 160}}};
  for (const BallModel& model : models) {
    const auto ball = centred_ball(model, 3000, 1490);
    for (const auto& [yaw, pitch, roll, h_fov] : views) {
      const auto view =
          ViewProjection::make({ViewKind::Perspective, {yaw, pitch, roll}, h_fov, {}, 333, 250})
              .value();
      const CoordinateGrid grid(view, ball, 3000, 3000);
      const Found found = compare(grid, view, ball);
      EXPECT_LE(found.worst, kPatchTolerance) << yaw << ' ' << pitch << ' ' << roll << ' ' << h_fov;
      EXPECT_EQ(found.wrongly_defined, 0);
    }
    const auto panorama =
        ViewProjection::make({ViewKind::Equirectangular, {20, 10, 5}, {}, {}, 512, 256}).value();
    const CoordinateGrid grid(panorama, ball, 3000, 3000);
    const Found found = compare(grid, panorama, ball);
    EXPECT_LE(found.worst, kPatchTolerance);
    EXPECT_EQ(found.wrongly_defined, 0);
  }
}

TEST(CoordinateGrid, KeepsThePictureOfAFullHdViewSmall) {
  const auto ball = centred_ball(BallModel::exact(348.5).value(), 3000, 1490);
  for (const optics::YawPitchRoll& o : {optics::YawPitchRoll{0, 0, 0}, {40, 20, 10}}) {
    const auto view = ViewProjection::make({ViewKind::Perspective, o, 90, {}, 1920, 1080}).value();
    const CoordinateGrid grid(view, ball, 3000, 3000);
    const Found found = compare(grid, view, ball);
    EXPECT_LE(found.worst, kPatchTolerance);
    EXPECT_LE(found.dense_tiles, grid.tiles_x() * grid.tiles_y() / 10);
  }
}

TEST(CoordinateGrid, FollowsACutAndTurnedBall) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-180, 180), radius(40, 600), centre(0, 640);
  for (int i = 0; i < 30; ++i) {
    const auto ball =
        BallProjection::make(
            BallModel::exact(345).value(),
            {{centre(random), centre(random)}, radius(random), radius(random), angle(random)},
            optics::rotation({angle(random), angle(random) / 2, angle(random)}))
            .value();
    const auto view = ViewProjection::make({ViewKind::Perspective,
                                            {angle(random), angle(random) / 2, angle(random)},
                                            100,
                                            {},
                                            129,
                                            97})
                          .value();
    const CoordinateGrid grid(view, ball, 640, 480);
    const Found found = compare(grid, view, ball);
    EXPECT_LE(found.worst, kPatchTolerance);
    // The exact map in fixed point and in double may differ on the picture's very border.
    EXPECT_LE(found.wrongly_defined, 2);
  }
}

TEST(CoordinateGrid, TellsBlindFromOutside) {
  const auto ball =
      BallProjection::make(BallModel::exact(300).value(), {{0, 50}, 40, 40, 0}, {}).value();
  const auto view = ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 360, 180}).value();
  const CoordinateGrid grid(view, ball, 100, 100);
  std::vector<std::uint8_t> storage(360 * 180);
  const ImageView<std::uint8_t> validity{storage.data(), 360, 180, 1, 360};
  grid.write_validity(validity);
  const auto at = [&](int lon) { return static_cast<Validity>(*validity.at(lon + 180, 90)); };
  EXPECT_EQ(at(-90), Validity::Seen);    // -X is on the right half of the ball's picture
  EXPECT_EQ(at(90), Validity::Outside);  // +X falls left of the picture
  EXPECT_EQ(at(-178), Validity::Blind);
  EXPECT_EQ(at(178), Validity::Blind);
}

}  // namespace
}  // namespace orbwatch::remap
