// SPDX-License-Identifier: Apache-2.0
// Rings of rising frequency, seen by a camera whose pixels are means over their area, against the
// view that would be made of 16x16 samples of the rings themselves.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proc/remap/remap.h"
#include "proc/remap/sampling/pyramid.h"
#include "proc/remap/sampling/sharpened_picture.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::Vec2;
using optics::ViewKind;
using optics::ViewProjection;
using tests::StoredPicture;

constexpr int kSide = 1110;
constexpr double kRadius = 540;
constexpr double kSharpness = 0.8;

BallProjection centred_ball_of_rings() {
  return BallProjection::make(BallModel::make(BallModel::Kind::Exact, 348.5).value(),
                              {{554.5, 554.5}, kRadius, kRadius, 0}, {})
      .value();
}

/// The rings' value at a place of the camera's picture; every 600 px are the centres of rings whose
/// frequency reaches a half per pixel between two centres.
double rings(const Vec2& at) {
  constexpr double kReach = 300;
  const double u = std::fmod(at.u + 130, 2 * kReach) - kReach;
  const double v = std::fmod(at.v + 210, 2 * kReach) - kReach;
  return 127.5 + 100 * std::cos(std::numbers::pi / 2 / kReach * (u * u + v * v));
}

/// The mean of `side` x `side` values of `of`, which cover the pixel (x, y).
template <class Of>
double mean_over_pixel(int side, int x, int y, const Of& of) {
  double sum = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      sum += of(x + (i + 0.5) / side - 0.5, y + (j + 0.5) / side - 0.5);
    }
  }
  return sum / (side * side);
}

void paint_rings(StoredPicture& picture) {
  const ImageView<std::uint8_t> samples = picture.picture.samples<std::uint8_t>();
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double value = mean_over_pixel(4, x, y, [](double u, double v) {
        return rings({u, v});
      });
      std::fill_n(samples.at(x, y), samples.channels,
                  static_cast<std::uint8_t>(std::lround(value)));
    }
  }
}

double bilinear_in(const Picture& picture, const Vec2& at) {
  const ImageView<const std::uint8_t> samples = picture.samples<const std::uint8_t>();
  const int u = std::clamp(static_cast<int>(std::floor(at.u)), 0, picture.width - 2);
  const int v = std::clamp(static_cast<int>(std::floor(at.v)), 0, picture.height - 2);
  const double wu = at.u - u, wv = at.v - v;
  return (*samples.at(u, v) * (1 - wu) + *samples.at(u + 1, v) * wu) * (1 - wv) +
         (*samples.at(u, v + 1) * (1 - wu) + *samples.at(u + 1, v + 1) * wu) * wv;
}

/// Source pixels between neighbours of a view along the axis with more, within the limits of a
/// level of the grid, and the mip level from which means of four are taken there.
struct Steps {
  double least, most;
  int mip_level;
};
constexpr Steps kSmaller{1.45, 2.7, 0}, kMuchSmaller{2.9, 5.4, 1};

/// A place of the source on one of its mip levels.
Vec2 on_mip_level(const Vec2& at, int level) {
  const double side = 1 << level;
  return {(at.u + 0.5) / side - 0.5, (at.v + 0.5) / side - 0.5};
}

/// A pixel of a view that is smaller than the source.
struct MinifiedPixel {
  int x, y;
  double truth;
  std::array<Vec2, 4> places;  ///< a quarter of a pixel before and behind it
};

std::vector<MinifiedPixel> minified_pixels(const ViewProjection& view, const BallProjection& ball,
                                           const Steps& steps) {
  const int every = 5 - 2 * steps.mip_level;
  std::vector<MinifiedPixel> pixels;
  const auto place = [&](double x, double y) { return ball.pixel(view.direction(x, y).value()); };
  for (int y = 2; y + 1 < view.height(); y += every) {
    for (int x = 2; x + 1 < view.width(); x += every) {
      const auto left = place(x - 1, y), right = place(x + 1, y), above = place(x, y - 1),
                 below = place(x, y + 1);
      if (!left || !right || !above || !below) continue;
      const double step = std::max(std::hypot(right->u - left->u, right->v - left->v),
                                   std::hypot(below->u - above->u, below->v - above->v)) /
                          2;
      if (step < steps.least || step > steps.most) continue;
      MinifiedPixel pixel{x, y, 0, {}};
      pixel.truth =
          mean_over_pixel(16, x, y, [&](double i, double j) { return rings(place(i, j).value()); });
      for (int k = 0; k < 4; ++k) {
        pixel.places[static_cast<std::size_t>(k)] =
            place(x + k % 2 * 0.5 - 0.25, y + k / 2 * 0.5 - 0.25).value();
      }
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

/// PSNR in dB.
struct RingsQuality {
  double ours;
  double four;  ///< of the mean of four bilinear samples for each pixel
};

RingsQuality rings_quality(const CoordinateGrid& grid, const std::vector<MinifiedPixel>& pixels,
                           int mip_level, PixelFormat format, bool sharpened) {
  StoredPicture seen(format, kSide, kSide);
  paint_rings(seen);
  std::optional<SharpenedPicture> sharp;
  if (sharpened) {
    sharp.emplace(format, kSide, kSide, kSharpness);
    sharp->set_source(seen.source);
    sharp->fill({0, 0, kSide, kSide});
  }
  const Picture source = sharpened ? sharp->picture() : seen.source;
  Pyramid pyramid(format, kSide, kSide, grid.pyramid_levels());
  pyramid.set_source(source);
  pyramid.fill();
  StoredPicture out(format, grid.width(), grid.height());
  remap(grid, pyramid.pictures(), Interpolation::Area, out.picture, {0, grid.tiles_y()});

  const Picture& read = pyramid.pictures()[static_cast<std::size_t>(mip_level)];
  double ours = 0, four = 0;
  for (const MinifiedPixel& pixel : pixels) {
    double mean = 0;
    for (const Vec2& at : pixel.places) {
      mean += bilinear_in(read, on_mip_level(at, mip_level)) / 4;
    }
    ours += std::pow(*out.picture.samples<std::uint8_t>().at(pixel.x, pixel.y) - pixel.truth, 2);
    four += std::pow(std::round(mean) - pixel.truth, 2);
  }
  const auto psnr = [&](double sum) {
    return 10 * std::log10(255 * 255 * static_cast<double>(pixels.size()) / sum);
  };
  return {psnr(ours), psnr(four)};
}

void expect_no_worse(const optics::ViewSpec& spec, const Steps& steps) {
  const auto ball = centred_ball_of_rings();
  const auto view = ViewProjection::make(spec).value();
  const CoordinateGrid grid(view, ball, kSide, kSide);
  const std::vector<MinifiedPixel> pixels = minified_pixels(view, ball, steps);
  EXPECT_GT(pixels.size(), 1500U);
  for (const auto& [format, sharpened] :
       {std::pair{PixelFormat::Grey, false}, {PixelFormat::Rgb, false}, {PixelFormat::Rgb, true}}) {
    SCOPED_TRACE(testing::Message() << info(format).name << ' ' << sharpened);
    const RingsQuality q = rings_quality(grid, pixels, steps.mip_level, format, sharpened);
    EXPECT_GE(q.ours, q.four - 0.1);
    const std::string of = std::string(info(format).name) + (sharpened ? "_sharpened" : "");
    testing::Test::RecordProperty(of + "_psnr", std::to_string(q.ours));
    testing::Test::RecordProperty(of + "_psnr_of_four", std::to_string(q.four));
  }
}

TEST(Aliasing, OfAPanoramaIsNoMoreThanOfFourSamples) {
  expect_no_worse({ViewKind::Equirectangular, {}, {}, {}, 1024, 512}, kSmaller);
}

TEST(Aliasing, OfAFlatViewIsNoMoreThanOfFourSamples) {
  expect_no_worse({ViewKind::Perspective, {10, 5, 30}, 100, {}, 320, 240}, kSmaller);
}

TEST(Aliasing, OfAPanoramaThatReadsAMipLevelIsNoMoreThanOfFourSamples) {
  expect_no_worse({ViewKind::Equirectangular, {}, {}, {}, 512, 256}, kMuchSmaller);
}

TEST(Aliasing, OfAFlatViewThatReadsAMipLevelIsNoMoreThanOfFourSamples) {
  expect_no_worse({ViewKind::Perspective, {10, 5, 30}, 100, {}, 160, 120}, kMuchSmaller);
}

}  // namespace
}  // namespace orbwatch::remap
