// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/coordinate_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <random>

#include "proc/optics/rotation.h"
#include "proc/optics/vec.h"
#include "proc/remap/compiler/tolerance.h"
#include "tests/proc/optics/random_camera.h"
#include "tests/proc/remap/grid/grid_scene.h"
#include "tests/support/share.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::Scene;
using optics::ViewKind;
using optics::ViewProjection;
using optics::ViewSpec;
using optics::YawPitchRoll;

struct Found {
  double worst = 0;         ///< largest distance of a defined pixel from the exact map, px
  double jump = 0;          ///< largest change of that error between neighbours, px
  int seen = 0;             ///< defined pixels
  int wrongly_defined = 0;  ///< pixels whose definedness differs
};

/// The exact map, where it lies within the source picture.
std::optional<optics::Vec2> exact(const CoordinateGrid& grid, const ViewProjection& view,
                                  const BallProjection& ball, int x, int y) {
  const auto direction = view.direction(x, y);
  if (!direction) return std::nullopt;
  const auto inside = [](double c, int size) { return c >= -0.5 && c <= size - 0.5; };
  const auto pixel = ball.pixel(*direction);
  if (!pixel || !inside(pixel->u, grid.source_width()) || !inside(pixel->v, grid.source_height())) {
    return std::nullopt;
  }
  return pixel;
}

/// Compares every pixel of a grid with the exact map, in pixels of the tile's mip level.
Found compare(const CoordinateGrid& grid, const ViewProjection& view, const BallProjection& ball) {
  Found found;
  // Undefined pixels have no error that could jump.
  const double nan = std::nan("");
  std::vector<optics::Vec2> above(grid.width(), {nan, nan}), current(grid.width());
  const auto look_at_jump = [&](const optics::Vec2& a, const optics::Vec2& b) {
    const double jump = std::hypot(a.u - b.u, a.v - b.v);
    if (jump > found.jump) found.jump = jump;
  };
  for (int y = 0; y < grid.height(); ++y) {
    CoordinateRow row{};
    for (int x = 0; x < grid.width(); ++x) {
      if (x % kTile == 0) row = grid.row(x / kTile, y / kTile, y % kTile);
      const Coordinate& mine = row[x % kTile];
      const auto truth = exact(grid, view, ball, x, y);
      found.wrongly_defined += is_defined(mine) != truth.has_value();
      current[x] = {nan, nan};
      if (!truth || !is_defined(mine)) continue;
      ++found.seen;
      const double scale = 1 << grid.tile(x / kTile, y / kTile).level;
      current[x] = {(mine.u / kOnePixel - truth->u) / scale,
                    (mine.v / kOnePixel - truth->v) / scale};
      found.worst = std::max(found.worst, std::hypot(current[x].u, current[x].v));
      if (x > 0) look_at_jump(current[x], current[x - 1]);
      look_at_jump(current[x], above[x]);
    }
    std::swap(above, current);
  }
  return found;
}

Found compare(const ViewSpec& spec, const BallProjection& ball, int source_width,
              int source_height) {
  const auto view = ViewProjection::make(spec, ball).value();
  const CoordinateGrid grid(view, ball, source_width, source_height);
  return compare(grid, view, ball);
}

void expect_exact(const ViewSpec& spec, const BallProjection& ball, int source_width,
                  int source_height) {
  const Found found = compare(spec, ball, source_width, source_height);
  EXPECT_LE(found.worst, kTolerance);
  EXPECT_LE(found.jump, 1.5 * kTolerance);
  // Fixed point and double may put a pixel on different sides of the picture's very border.
  EXPECT_LE(found.wrongly_defined, 2);
}

/// The nearest camera of the reference pictures, in its machine.
BallProjection machine(Scene::Room room, bool table) {
  const optics::Ball ball{{120, 60, 430}, 50};
  const optics::Vec3 forward = optics::normalized({-0.15189524, 0.98322088, -0.10101755});
  const optics::Vec3 right = optics::normalized(optics::cross(forward, {0, 0, 1}));
  const optics::CalibratedCamera camera{
      optics::Lens::make({1500, 1500, 7892.452, 7892.452, 749.5, 749.5}).value(),
      {{right, optics::cross(forward, right), forward}, {208.572, -530.481, 489.048}},
      {}};
  Scene scene;
  scene.room = room;
  scene.walls = {{-600, -500, 0}, {600, 500, 800}};
  if (table) scene.obstacles = {{{-250, -200, 100}, {250, 200, 140}}};
  return BallProjection::make(BallModel::Kind::Exact, camera, ball,
                              optics::SceneProxy::make(scene, ball).value())
      .value();
}

constexpr YawPitchRoll kOrientations[]{{0, 0, 0},   {40, 20, 10},  {110, -30, 45},  {-115, -40, 0},
                                       {180, 0, 0}, {160, -20, 0}, {-150, -60, 30}, {90, -60, 0}};

TEST(CoordinateGrid, IsExactToASixtyFourthOfAPixel) {
  const std::array models{BallModel::make(BallModel::Kind::Exact, 348.5).value(),
                          BallModel::make(BallModel::Kind::Exact, 300).value(),
                          BallModel::make(BallModel::Kind::Exact, 360).value(),
                          BallModel::make(BallModel::Kind::Paper, 346).value(),
                          BallModel::make(BallModel::Kind::Classical).value()};
  const std::array<std::array<double, 4>, 7> views{{{0, 0, 0, 90},
                                                    {40, 20, 10, 90},
                                                    {110, -30, 45, 90},
                                                    {180, 0, 0, 90},
                                                    {170, 60, 30, 120},
                                                    {10, 0, 0, 5},
                                                    {-90, -90, 0, 160}}};
  tests::DrawnShare share(40);
  for (const BallModel& model : models) {
    const auto ball = centred_ball(model, 3000, 1490);
    for (const auto& [yaw, pitch, roll, h_fov] : views) {
      if (!share.next()) continue;
      SCOPED_TRACE(testing::Message() << yaw << ' ' << pitch << ' ' << roll << ' ' << h_fov);
      expect_exact({ViewKind::Perspective, {yaw, pitch, roll}, h_fov, {}, 333, 250}, ball, 3000,
                   3000);
    }
    if (!share.next()) continue;
    expect_exact({ViewKind::Equirectangular, {20, 10, 5}, {}, {}, 512, 256}, ball, 3000, 3000);
  }
}

TEST(CoordinateGrid, IsExactInEveryRoomAndKindOfView) {
  tests::DrawnShare cases(48);
  std::mt19937 random(21);
  std::uniform_real_distribution<double> angle(-180, 180), share(0, 1);
  for (const Scene::Room room :
       {Scene::Room::None, Scene::Room::Sphere, Scene::Room::Plane, Scene::Room::Box}) {
    for (const bool obstacles : {false, true}) {
      const auto camera = tests::random_camera(random, 1.5 + 15 * share(random), 10);
      const auto ball = BallProjection::make(BallModel::Kind::Exact, camera, tests::kBall,
                                             tests::scene_around_ball(room, obstacles))
                            .value();
      for (const ViewKind kind :
           {ViewKind::Perspective, ViewKind::Equirectangular, ViewKind::Cylindrical,
            ViewKind::Stereographic, ViewKind::Fisheye, ViewKind::Ball}) {
        SCOPED_TRACE(testing::Message() << "room " << static_cast<int>(room) << ' ' << obstacles
                                        << " view " << static_cast<int>(kind));
        YawPitchRoll turned{angle(random), angle(random) / 2, angle(random)};
        if (kind == ViewKind::Ball) turned = {};
        if (!cases.next()) continue;
        expect_exact({kind, turned, {}, {}, 301, 203}, ball, 4000, 3000);
      }
    }
  }
}

// Nodes are full turns apart there, and would all be alike.
TEST(CoordinateGrid, IsExactInPanoramasOfAFewPixels) {
  const auto ball = centred_ball(BallModel::make(BallModel::Kind::Exact, 300).value(), 400, 190);
  for (const ViewKind kind : {ViewKind::Equirectangular, ViewKind::Cylindrical}) {
    for (int side = 1; side <= 24; ++side) {
      SCOPED_TRACE(side);
      const auto view = ViewProjection::make({kind, {80, 10, 5}, {}, {}, side, side}).value();
      const Found found = compare(CoordinateGrid(view, ball, 400, 400), view, ball);
      EXPECT_LE(found.worst, kTolerance);
      EXPECT_EQ(found.wrongly_defined, 0);
    }
  }
}

TEST(CoordinateGrid, FollowsEdgesOfTheMachine) {
  const auto ball = machine(Scene::Room::Box, true);
  for (const YawPitchRoll& o : kOrientations) {
    SCOPED_TRACE(testing::Message() << o.yaw << ' ' << o.pitch << ' ' << o.roll);
    expect_exact({ViewKind::Perspective, o, 90, {}, 640, 360}, ball, 1500, 1500);
  }
}

TEST(CoordinateGrid, SeesThroughDistortionAndGlass) {
  optics::Intrinsics lens{1500, 1500, 2400, 2380, 749.5, 749.5};
  lens.distortion = optics::Distortion::Pinhole;
  lens.coefficients = {-0.2, 0.05, 0.001, -0.0005};
  const optics::Pose pose{{{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                          tests::kBall.centre + optics::Vec3{20, 300, -15}};
  const optics::CalibratedCamera camera{optics::Lens::make(lens).value(), pose,
                                        optics::Window{{0.2, 1, 0}, 10, 1.52}};
  const auto ball = BallProjection::make(BallModel::Kind::Exact, camera, tests::kBall,
                                         tests::scene_around_ball(Scene::Room::Box, true))
                        .value();
  expect_exact({ViewKind::Perspective, {30, -30, 0}, 100, {}, 320, 240}, ball, 1500, 1500);
  expect_exact({ViewKind::Equirectangular, {}, {}, {}, 256, 128}, ball, 1500, 1500);
}

TEST(CoordinateGrid, KeepsTheMapOfAFullHdViewSmall) {
  for (const bool table : {false, true}) {
    const auto ball = machine(table ? Scene::Room::Box : Scene::Room::None, table);
    for (const YawPitchRoll& o : kOrientations) {
      const auto view =
          ViewProjection::make({ViewKind::Perspective, o, 90, {}, 1920, 1080}).value();
      const CoordinateGrid grid(view, ball, 1500, 1500);
      EXPECT_LE(grid.bytes(), 600 * 1024U) << o.yaw << ' ' << o.pitch << ' ' << o.roll;
    }
  }
}

TEST(CoordinateGrid, AFullHdViewIsMadeOfPatches) {
  const auto ball =
      centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 3000, 1490);
  for (const YawPitchRoll& o : {YawPitchRoll{0, 0, 0}, {40, 20, 10}}) {
    const auto view = ViewProjection::make({ViewKind::Perspective, o, 90, {}, 1920, 1080}).value();
    const CoordinateGrid grid(view, ball, 3000, 3000);
    int patches = 0;
    for (int ty = 0; ty < grid.tiles_y(); ++ty) {
      for (int tx = 0; tx < grid.tiles_x(); ++tx) {
        patches += is_patch(grid.tile(tx, ty).kind) && grid.tile(tx, ty).interior;
      }
    }
    EXPECT_EQ(patches, grid.tiles_x() * grid.tiles_y());
    EXPECT_LE(compare(grid, view, ball).worst, kTolerance / 10);
  }
}

/// A panorama of the size of a display's view, most of which is smaller than the ball's picture.
struct SmallPanorama {
  BallProjection ball =
      centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 1100, 540);
  ViewProjection view =
      ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 1024, 512}).value();
  CoordinateGrid grid{view, ball, 1100, 1100};
};

TEST(CoordinateGrid, APanoramaHasPatchesWhereItIsSmaller) {
  int smaller = 0, patches = 0;
  for_each_tile(SmallPanorama().grid, [&](const Tile& tile, int, int) {
    smaller += tile.level > 0;
    patches += tile.level > 0 && is_patch(tile.kind);
  });
  EXPECT_GT(smaller, 1500);
  EXPECT_GT(patches, smaller / 3);
}

TEST(CoordinateGrid, AFittedPatchIsExact) {
  const SmallPanorama scene;
  int found = 0;
  double worst = 0;
  for_each_tile(scene.grid, [&](const Tile& tile, int tx, int ty) {
    if (tile.kind != TileKind::OwnPatch) return;
    ++found;
    const Patch patch(scene.grid.nodes(tile, tx, ty));
    for (int y = 0; y < kTile; ++y) {
      for (int x = 0; x < kTile; ++x) {
        const Coordinate mine = patch.at(x, y);
        const auto truth =
            exact(scene.grid, scene.view, scene.ball, tx * kTile + x, ty * kTile + y);
        const double error =
            std::hypot(mine.u / kOnePixel - truth->u, mine.v / kOnePixel - truth->v);
        worst = std::max(worst, error / (1 << tile.level));
      }
    }
  });
  EXPECT_GT(found, 500);
  EXPECT_LE(worst, kTolerance);
}

TEST(CoordinateGrid, KeepsEachTileInTheLeastThatDescribesIt) {
  std::map<TileKind, int> kinds;
  const auto count = [&](const BallProjection& ball, const ViewSpec& spec, int size) {
    const CoordinateGrid grid(ViewProjection::make(spec).value(), ball, size, size);
    for_each_tile(grid, [&](const Tile& tile, int, int) { ++kinds[tile.kind]; });
  };
  count(machine(Scene::Room::Box, true), {ViewKind::Perspective, {-115, -40, 0}, 90, {}, 1280, 720},
        1500);
  const int crossed = kinds[TileKind::Split];
  EXPECT_GT(crossed, 100);
  EXPECT_GT(kinds[TileKind::OwnPatch], crossed);
  EXPECT_LT(kinds[TileKind::Pixels], crossed / 10);  // corners, where three surfaces meet
  count(centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 3000, 1490),
        {ViewKind::Perspective, {180, 0, 0}, 90, {}, 1280, 720}, 3000);
  for (const TileKind kind : {TileKind::Patch, TileKind::Curved, TileKind::Fine,
                              TileKind::CurvedFine, TileKind::Pixels}) {
    EXPECT_GT(kinds[kind], 0) << static_cast<int>(kind);
  }
}

/// The least distance in px by which any pixel of a tile exceeds the requirement of `interior`;
/// below 0 if it does not meet it.
double clearance(const CoordinateGrid& grid, const Tile& tile, int tx, int ty) {
  const double scale = 1 << tile.level;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](double c, int size) {
    least = std::min({least, c - kInteriorBefore * scale, size - kInteriorBeyond * scale - c});
  };
  for (int y = 0; y < kTile; ++y) {
    for (const Coordinate& c : grid.row(tx, ty, y)) {
      look(c.u / kOnePixel, grid.source_width());
      look(c.v / kOnePixel, grid.source_height());
    }
  }
  return least;
}

TEST(CoordinateGrid, GivesATileAtOnceAsRowByRow) {
  const auto ball =
      centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 3000, 1490);
  const auto view =
      ViewProjection::make({ViewKind::Perspective, {170, 10, 20}, 90, {}, 640, 360}).value();
  const CoordinateGrid grid(view, ball, 2000, 3000);
  for_each_tile(grid, [&](const Tile&, int tx, int ty) {
    const CoordinateTile pixels = grid.pixels(tx, ty);
    for (int y = 0; y < kTile; ++y) {
      const CoordinateRow row = grid.row(tx, ty, y);
      for (int x = 0; x < kTile; ++x) {
        ASSERT_EQ(pixels[y][x].u, row[x].u);
        ASSERT_EQ(pixels[y][x].v, row[x].v);
      }
    }
  });
}

TEST(CoordinateGrid, KnowsWhereATileLiesInTheSource) {
  const auto ball = centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 1000, 480);
  const auto view =
      ViewProjection::make({ViewKind::Perspective, {20, 10, 20}, 90, {}, 640, 360}).value();
  const CoordinateGrid grid(view, ball, 900, 1000);
  constexpr int kBulge = 2;  // px, of a patch beyond its corners
  int looked_at = 0;
  for_each_tile(grid, [&](const Tile& tile, int tx, int ty) {
    if (!is_patch(tile.kind)) return;
    const SourceArea extent = grid.extent(tx, ty);
    ASSERT_EQ(extent, common(extent, {0, 0, 900, 1000}));
    for (const CoordinateRow& row : grid.pixels(tx, ty)) {
      for (const Coordinate& c : row) {
        const int u = c.u >> kFractionBits, v = c.v >> kFractionBits;
        if (u < 0 || v < 0 || u >= 900 || v >= 1000) continue;
        ASSERT_TRUE(u >= extent.left - kBulge && u < extent.right + kBulge) << tx << ' ' << ty;
        ASSERT_TRUE(v >= extent.top - kBulge && v < extent.bottom + kBulge) << tx << ' ' << ty;
      }
    }
    ++looked_at;
  });
  EXPECT_GT(looked_at, 500);
  EXPECT_TRUE(grid.extent(grid.tiles_x(), 0).is_empty());
  EXPECT_TRUE(grid.extent(0, grid.tiles_y()).is_empty());
}

TEST(CoordinateGrid, InteriorTilesKeepTheirDistanceToTheBorder) {
  const auto ball = centred_ball(BallModel::make(BallModel::Kind::Exact, 348.5).value(), 1000, 600);
  std::map<bool, int> count;
  for (const int width : {70, 150, 300, 1000}) {
    const auto view =
        ViewProjection::make({ViewKind::Perspective, {70, 10, 30}, 130, {}, width, width}).value();
    const CoordinateGrid grid(view, ball, 1000, 1000);
    for_each_tile(grid, [&](const Tile& tile, int tx, int ty) {
      if (!is_patch(tile.kind) && !tile.interior) return;
      const double distance = clearance(grid, tile, tx, ty);
      ++count[tile.interior];
      if (tile.interior) {
        EXPECT_GE(distance, 0);
      } else {
        EXPECT_LE(distance, 1.5 * (1 << tile.level)) << "refused by more than a pixel's step";
      }
    });
  }
  EXPECT_GT(count[true], 500);
  EXPECT_GT(count[false], 10);
}

TEST(CoordinateGrid, FollowsACutAndTurnedBall) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-180, 180), radius(40, 600), centre(0, 640);
  for (int i = tests::share_of(30); i > 0; --i) {
    const auto ball =
        BallProjection::make(
            BallModel::make(BallModel::Kind::Exact, 345).value(),
            {{centre(random), centre(random)}, radius(random), radius(random), angle(random)},
            optics::rotation({angle(random), angle(random) / 2, angle(random)}))
            .value();
    expect_exact({ViewKind::Perspective,
                  {angle(random), angle(random) / 2, angle(random)},
                  100,
                  {},
                  129,
                  97},
                 ball, 640, 480);
  }
}

TEST(CoordinateGrid, FollowsAnyCalibratedCamera) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-180, 180), share(0, 1);
  const auto proxy = tests::scene_around_ball(Scene::Room::Box, true);
  int seen = 0;
  const int cases = tests::share_of(30);
  for (int i = 0; i < cases; ++i) {
    const auto camera =
        tests::random_camera(random, 1.3 + 20 * share(random) * share(random), 20 * share(random));
    const auto ball =
        BallProjection::make(BallModel::Kind::Exact, camera, tests::kBall, proxy).value();
    const ViewSpec spec{ViewKind::Perspective,
                        {angle(random), angle(random) / 2, angle(random)},
                        20 + 130 * share(random),
                        {},
                        161,
                        129};
    const Found found = compare(spec, ball, 4000, 3000);
    EXPECT_LE(found.worst, kTolerance);
    EXPECT_LE(found.wrongly_defined, 2);
    seen += found.seen;
  }
  EXPECT_GT(seen, cases * 6500);
}

TEST(CoordinateGrid, TellsBlindFromOutside) {
  const auto ball = BallProjection::make(BallModel::make(BallModel::Kind::Exact, 300).value(),
                                         {{0, 50}, 40, 40, 0}, {})
                        .value();
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
