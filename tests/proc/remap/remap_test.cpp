// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/remap.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <thread>

#include "proc/optics/rotation.h"
#include "proc/optics/vec.h"
#include "proc/remap/colour/colour_conversion.h"
#include "tests/proc/reference_optics.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::Vec2;
using optics::Vec3;
using optics::ViewKind;
using optics::ViewProjection;
using optics::ViewSpec;
using tests::StoredPicture;

/// A room with soft and hard edges: the slopes of photographs.
template <class T>
void paint_room(const ImageView<T>& out) {
  const double full = std::numeric_limits<T>::max();
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      for (int k = 0; k < out.channels; ++k) {
        const double wave =
            std::sin(x * 0.071 + k) * std::cos(y * 0.053) + std::sin((x + y) * 0.31);
        const bool bright = (x / 61 + y / 47 + k) % 2 != 0;
        out.at(x, y)[k] = static_cast<T>(full * (0.4 + 0.12 * wave + (bright ? 0.2 : 0)));
      }
    }
  }
}

template <class T>
double bilinear_at(const ImageView<const T>& in, const Vec2& p, int channel) {
  const auto at = [&](double x, double y) {
    return static_cast<double>(in.at(std::clamp(static_cast<int>(x), 0, in.width - 1),
                                     std::clamp(static_cast<int>(y), 0, in.height - 1))[channel]);
  };
  const double x = std::floor(p.u), y = std::floor(p.v), wu = p.u - x, wv = p.v - y;
  return (at(x, y) * (1 - wu) + at(x + 1, y) * wu) * (1 - wv) +
         (at(x, y + 1) * (1 - wu) + at(x + 1, y + 1) * wu) * wv;
}

struct Agreement {
  int compared = 0;
  int off_by_more_than_one = 0;
};

/// Compares every pixel of the view of a room, except 2 px at the limb and the classical model's 3
/// degrees, with the double-precision reference. `tolerance`: of a sample where the view is not
/// smaller than the room; places are less exact by the factor of a tile's mip level.
template <class T>
Agreement compare(const ViewSpec& spec, const tests::ReferenceBall& reference,
                  const BallModel& model, const StoredPicture& room, double tolerance) {
  StoredPicture result(room.source.format, spec.width, spec.height);
  const auto ball = BallProjection::make(model, reference.outline, reference.registration).value();
  const auto view = ViewProjection::make(spec).value();
  const CoordinateGrid grid(view, ball, room.source.width, room.source.height);
  remap(grid, room.as_source(), Interpolation::Bilinear, result.picture, {0, grid.tiles_y()});

  const Vec3 blind = reference.registration * Vec3{0, -1, 0};
  const ImageView<const T> in = room.source.samples<T>();
  Agreement agreement;
  for (int y = 0; y < spec.height; ++y) {
    for (int x = 0; x < spec.width; ++x) {
      const Vec3 direction = view.direction(x, y).value();
      const auto truth = reference.pixel(direction);
      if (!truth) {
        EXPECT_EQ(*result.picture.samples<T>().at(x, y), 0) << "blind pixel " << x << ' ' << y;
        continue;
      }
      const Vec2 from_centre{truth->u - reference.outline.centre.u,
                             truth->v - reference.outline.centre.v};
      if (std::hypot(from_centre.u, from_centre.v) > reference.outline.rx - 2) continue;
      if (model.kind() == BallModel::Kind::Classical &&
          optics::angle_between(direction, blind) < optics::radians(3)) {
        continue;
      }
      for (int k = 0; k < in.channels; ++k) {
        const double error = result.picture.samples<T>().at(x, y)[k] - bilinear_at(in, *truth, k);
        ++agreement.compared;
        const int level = grid.tile(x / kTile, y / kTile).level;
        agreement.off_by_more_than_one += std::abs(error) > tolerance * (1 << level);
      }
    }
  }
  return agreement;
}

TEST(Remap, EqualsTheReferenceInEveryDirectionForEveryModel) {
  const double alpha = 348.5;
  const std::array models{BallModel::make(BallModel::Kind::Exact, alpha).value(),
                          BallModel::make(BallModel::Kind::Paper, alpha).value(),
                          BallModel::make(BallModel::Kind::Classical).value()};
  const tests::ReferenceBall base{
      BallModel::Kind::Exact, alpha, {{497.3, 502.8}, 480, 480, 0}, optics::rotation({15, -8, 3})};
  StoredPicture colour(PixelFormat::Rgb, 1000, 1000), grey(PixelFormat::Grey, 1000, 1000);
  for (const StoredPicture* room : {&colour, &grey})
    paint_room(room->picture.samples<std::uint8_t>());
  for (const BallModel& model : models) {
    tests::ReferenceBall reference = base;
    reference.kind = model.kind();
    Agreement total;
    for (const double yaw : {0, 60, 120, 180, 240, 300}) {
      for (const double pitch : {-60, 0, 60}) {
        const ViewSpec spec{ViewKind::Perspective, {yaw, pitch, yaw / 7}, 80, {}, 120, 90};
        const Agreement a = compare<std::uint8_t>(spec, reference, model, colour, 1);
        total.compared += a.compared;
        total.off_by_more_than_one += a.off_by_more_than_one;
        EXPECT_LE(a.off_by_more_than_one, a.compared / 1000) << "yaw " << yaw << " pitch " << pitch;
      }
    }
    const ViewSpec panorama{ViewKind::Equirectangular, {}, {}, {}, 240, 120};
    const Agreement a = compare<std::uint8_t>(panorama, reference, model, grey, 1);
    EXPECT_LE(a.off_by_more_than_one, a.compared / 1000);
    EXPECT_GT(total.compared, 400000);
  }
}

TEST(Remap, KeepsSixteenBits) {
  const tests::ReferenceBall reference{BallModel::Kind::Exact, 345, {{499, 499}, 480, 480, 0}, {}};
  const BallModel model = BallModel::make(BallModel::Kind::Exact, 345).value();
  const ViewSpec spec{ViewKind::Perspective, {30, 10, 0}, 90, {}, 320, 240};
  for (const PixelFormat format : {PixelFormat::Y16, PixelFormat::Rgb16}) {
    StoredPicture room(format, 1000, 1000);
    paint_room(room.picture.samples<std::uint16_t>());
    // The tolerance is one grey level of 8 bit.
    const Agreement a = compare<std::uint16_t>(spec, reference, model, room, 257);
    EXPECT_GT(a.compared, 70000);
    EXPECT_LE(a.off_by_more_than_one, a.compared / 1000);
  }
}

struct SmallScene {
  ViewProjection view =
      ViewProjection::make({ViewKind::Perspective, {20, 5, 3}, 100, {}, 70, 45}).value();
  BallProjection ball = BallProjection::make(BallModel::make(BallModel::Kind::Exact, 340).value(),
                                             {{30, 33}, 40, 40, 0}, {})
                            .value();
  CoordinateGrid grid{view, ball, 64, 48};  // the picture cuts the ball
};

TEST(Remap, NearestTakesTheClosestPixel) {
  const SmallScene scene;
  StoredPicture source(PixelFormat::Y16, 64, 48), result(PixelFormat::Y16, 70, 45);
  std::uint16_t* const counts = source.picture.samples<std::uint16_t>().data;
  for (int i = 0; i < 64 * 48; ++i) counts[i] = static_cast<std::uint16_t>(i + 1);
  remap(scene.grid, source.as_source(), Interpolation::Nearest, result.picture,
        {0, scene.grid.tiles_y()});
  int compared = 0;
  for (int y = 0; y < 45; ++y) {
    for (int x = 0; x < 70; ++x) {
      const auto p = scene.ball.pixel(*scene.view.direction(x, y));
      if (!p || p->u < -0.5 || p->v < -0.5 || p->u > 63.5 || p->v > 47.5) {
        EXPECT_EQ(*result.picture.samples<std::uint16_t>().at(x, y), 0);
        continue;
      }
      // Either neighbour is right within the grid's tolerance of a pixel's edge.
      const auto edge = [](double c) { return std::abs(c - std::floor(c) - 0.5) < 0.016; };
      if (edge(p->u) || edge(p->v)) continue;
      ++compared;
      EXPECT_EQ(*result.picture.samples<std::uint16_t>().at(x, y),
                std::lround(p->v) * 64 + std::lround(p->u) + 1);
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(Remap, YuyvEqualsRemappedPlanesConvertedAfterwards) {
  const SmallScene scene;
  StoredPicture source(PixelFormat::Yuyv, 64, 48, 12);
  std::mt19937 random(5);
  for (std::byte& sample : source.bytes) sample = static_cast<std::byte>(random());
  StoredPicture result(PixelFormat::Rgb, 70, 45);
  remap(scene.grid, source.as_source(), Interpolation::Bilinear, result.picture,
        {0, scene.grid.tiles_y()});
  const auto in = source.picture.samples<std::uint8_t>();
  const YuvToRgb convert(ColourSpace{});
  int compared = 0;
  for (int y = 0; y < 45; ++y) {
    for (int x = 0; x < 70; ++x) {
      const auto p = scene.ball.pixel(*scene.view.direction(x, y));
      const auto even = scene.ball.pixel(*scene.view.direction(x - x % 2, y));
      if (!p || p->u < 0 || p->v < 0 || p->u > 61 || p->v > 46) continue;
      if (!even || even->u < 0 || even->v < 0 || even->u > 61 || even->v > 46) continue;
      // Chroma as a plane of half width whose samples are at even pixels, in picture and view.
      const auto plane = [&](double u, double v, int step, int offset) {
        const double a = std::floor(u), b = std::floor(v), wu = u - a, wv = v - b;
        const auto at = [&](double i, double j) {
          return static_cast<double>(
              in.row(static_cast<int>(j))[static_cast<int>(i) * step + offset]);
        };
        return (at(a, b) * (1 - wu) + at(a + 1, b) * wu) * (1 - wv) +
               (at(a, b + 1) * (1 - wu) + at(a + 1, b + 1) * wu) * wv;
      };
      std::uint8_t truth[3];
      convert(static_cast<int>(std::lround(plane(p->u, p->v, 2, 0))),
              static_cast<int>(std::lround(plane(even->u / 2, even->v, 4, 1))),
              static_cast<int>(std::lround(plane(even->u / 2, even->v, 4, 3))), truth);
      ++compared;
      // White noise: a sixty-fourth of a pixel is worth up to 4 levels of Y and 2.0 x 2 of chroma.
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(result.picture.samples<std::uint8_t>().at(x, y)[k], truth[k], 10);
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(Remap, RowsMayBeSharedByThreads) {
  const SmallScene scene;
  StoredPicture source(PixelFormat::Rgb, 64, 48), whole(PixelFormat::Rgb, 70, 45, 5),
      shared(PixelFormat::Rgb, 70, 45, 5);
  paint_room(source.picture.samples<std::uint8_t>());
  remap(scene.grid, source.as_source(), Interpolation::Bilinear, whole.picture,
        {0, scene.grid.tiles_y()});
  std::thread other([&] {
    remap(scene.grid, source.as_source(), Interpolation::Bilinear, shared.picture, {0, 1});
  });
  remap(scene.grid, source.as_source(), Interpolation::Bilinear, shared.picture,
        {1, scene.grid.tiles_y()});
  other.join();
  EXPECT_EQ(whole.bytes, shared.bytes);
}

}  // namespace
}  // namespace orbwatch::remap
