// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/tile_conversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/proc/remap/stored_picture.h"
#include "tests/proc/remap/untouched.h"

namespace orbwatch::remap {
namespace {

using tests::kUntouched;
using tests::StoredPicture;

SampledTile noise() {
  SampledTile tile;
  std::mt19937 random(1);
  for (auto& plane : tile.planes) {
    for (std::uint8_t& byte : plane) byte = static_cast<std::uint8_t>(random());
  }
  return tile;
}

/// A view to which nothing has been written yet.
class BlankView : public StoredPicture {
 public:
  BlankView(PixelFormat format, int width, int height) : StoredPicture(format, width, height, 6) {
    std::fill(bytes.begin(), bytes.end(), std::byte{kUntouched});
  }

  std::byte& at(std::size_t plane, int row, int byte) {
    return picture.planes[plane].data[row * picture.planes[plane].stride + byte];
  }
};

/// Whole and cut tiles of views that are even or not.
struct TilePlace {
  int width, height;  ///< size of the view
  TileArea area;
};
constexpr std::array<TilePlace, 4> kEvenPlaces{{{38, 42, {0, 0, 16, 16}},
                                                {38, 42, {32, 16, 6, 16}},
                                                {38, 42, {32, 32, 6, 10}},
                                                {2, 2, {0, 0, 2, 2}}}};
constexpr std::array<TilePlace, 3> kOddPlaces{
    {{37, 41, {16, 32, 16, 9}}, {37, 41, {32, 16, 5, 16}}, {1, 1, {0, 0, 1, 1}}}};

template <class Look>
void for_each_place(bool odd_too, const Look& look) {
  const auto one = [&](const TilePlace& place) {
    SCOPED_TRACE(testing::Message() << place.width << 'x' << place.height << " at " << place.area.x
                                    << ' ' << place.area.y);
    look(place);
  };
  std::for_each(kEvenPlaces.begin(), kEvenPlaces.end(), one);
  if (odd_too) std::for_each(kOddPlaces.begin(), kOddPlaces.end(), one);
}

bool is_packed_yuv(PixelFormat format) {
  return format == PixelFormat::Yuyv || format == PixelFormat::Uyvy;
}
bool is_yuv(PixelFormat format) { return info(format).colour == ColourModel::Yuv; }

TEST(WritePlanes, SeparatesWhatWriteTileInterleaves) {
  const SampledTile tile = noise();
  for (const PixelFormatInfo& facts : kPixelFormats) {
    if (facts.colour == ColourModel::Luminance || facts.bytes_per_sample() > 1) continue;
    for (const PixelFormat order : {PixelFormat::Rgb, PixelFormat::Bgr}) {
      SCOPED_TRACE(testing::Message() << facts.name << " to " << info(order).name);
      BlankView expected(order, kTile, kTile);
      const ColourSpace space{ColourMatrix::Bt709, ColourRange::Limited};
      write_tile(tile, facts.format, space, expected.picture, {0, 0, kTile, kTile},
                 scalar_kernel());
      PlanarTile found;
      write_planes(tile, facts.format, space, order, found);
      for (int y = 0; y < kTile; ++y) {
        for (int i = 0; i < 3 * kTile; ++i) {
          ASSERT_EQ(std::byte{found.row(i % 3, y)[i / 3]}, expected.at(0, y, i)) << i << ", " << y;
        }
      }
    }
  }
}

TEST(WriteTile, CopiesPlanesInTheirOwnFormat) {
  const SampledTile tile = noise();
  for (const PixelFormatInfo& facts : kPixelFormats) {
    if (is_packed_yuv(facts.format)) continue;
    SCOPED_TRACE(facts.name);
    for_each_place(!is_yuv(facts.format), [&](const TilePlace& place) {
      BlankView found(facts.format, place.width, place.height);
      BlankView expected(facts.format, place.width, place.height);
      write_tile(tile, facts.format, {}, found.picture, place.area, scalar_kernel());
      for (std::size_t n = 0; n < facts.plane_count(); ++n) {
        const PlaneInfo& plane = facts.planes[n];
        const int pixel = plane.samples * facts.bytes_per_sample();
        const int left = (place.area.x >> plane.shift_x) * pixel;
        for (int y = 0; y < place.area.rows >> plane.shift_y; ++y) {
          for (int k = 0; k < (place.area.columns >> plane.shift_x) * pixel; ++k) {
            expected.at(n, (place.area.y >> plane.shift_y) + y, left + k) =
                std::byte{tile.planes[n][y * kTile * pixel + k]};
          }
        }
      }
      EXPECT_EQ(found.bytes, expected.bytes);
    });
  }
}

/// Luminance and chroma of a pixel of a sampled tile.
struct Yuv {
  double y, u, v;
};

Yuv yuv_at(const SampledTile& tile, PixelFormat format, int x, int y) {
  const auto pair = [&](int row) {
    const std::uint8_t* const both = &tile.planes[1][2 * (row * kTile + x / 2)];
    return std::array{both[0], both[1]};
  };
  const double luminance = tile.planes[0][y * kTile + x];
  switch (format) {
    case PixelFormat::I420: {
      const int shared = y / 2 * kTile + x / 2;
      return {luminance, double(tile.planes[1][shared]), double(tile.planes[2][shared])};
    }
    case PixelFormat::Nv12:
      return {luminance, double(pair(y / 2)[0]), double(pair(y / 2)[1])};
    case PixelFormat::Nv21:
      return {luminance, double(pair(y / 2)[1]), double(pair(y / 2)[0])};
    default:
      return {luminance, double(pair(y)[0]), double(pair(y)[1])};
  }
}

TEST(WriteTile, LetsLuminanceAndChromaTakeTurns) {
  const SampledTile tile = noise();
  for (const PixelFormat format : {PixelFormat::Yuyv, PixelFormat::Uyvy}) {
    for_each_place(false, [&](const TilePlace& place) {
      BlankView found(format, place.width, place.height),
          expected(format, place.width, place.height);
      write_tile(tile, format, {}, found.picture, place.area, scalar_kernel());
      for (int y = 0; y < place.area.rows; ++y) {
        for (int x = 0; x < place.area.columns; ++x) {
          const Yuv pixel = yuv_at(tile, format, x, y);
          const int luminance = format == PixelFormat::Yuyv ? 0 : 1;
          const auto put = [&](int place_in_pixel, double value) {
            expected.at(0, place.area.y + y, 2 * (place.area.x + x) + place_in_pixel) =
                static_cast<std::byte>(value);
          };
          put(luminance, pixel.y);
          put(1 - luminance, x % 2 == 0 ? pixel.u : pixel.v);
        }
      }
      EXPECT_EQ(found.bytes, expected.bytes);
    });
  }
}

/// ITU-R BT.601 and BT.709 by their definition: from samples to shares of full scale, the inverse
/// of E'Y = Kr E'R + Kg E'G + Kb E'B with the differences scaled to +-1/2, and to 8 bit.
std::array<double, 3> to_rgb(const Yuv& pixel, ColourSpace space) {
  const bool hd = space.matrix == ColourMatrix::Bt709, full = space.range == ColourRange::Full;
  const double kr = hd ? 0.2126 : 0.299, kb = hd ? 0.0722 : 0.114;
  const double luminance = full ? pixel.y / 255 : (pixel.y - 16) / 219;
  const double cb = (pixel.u - 128) / (full ? 255 : 224), cr = (pixel.v - 128) / (full ? 255 : 224);
  const double red = luminance + 2 * (1 - kr) * cr, blue = luminance + 2 * (1 - kb) * cb;
  const double green = (luminance - kr * red - kb * blue) / (1 - kr - kb);
  std::array<double, 3> rgb{red, green, blue};
  for (double& share : rgb) share = 255 * std::clamp(share, 0.0, 1.0);
  return rgb;
}

/// Writes a tile of `from` as `to` and checks each sample: `expected(x, y)` in R G B, within
/// `tolerance`. Nothing beside the area may change.
template <class Expected>
void expect_colours(const SampledTile& tile, PixelFormat from, ColourSpace space, PixelFormat to,
                    const TilePlace& place, double tolerance, const Expected& expected) {
  BlankView view(to, place.width, place.height);
  write_tile(tile, from, space, view.picture, place.area, scalar_kernel());
  for (const Kernel* kernel : kernels()) {
    BlankView same(to, place.width, place.height);
    write_tile(tile, from, space, same.picture, place.area, *kernel);
    ASSERT_EQ(same.bytes, view.bytes) << kernel->name;
  }
  for (int y = 0; y < place.area.rows; ++y) {
    for (int x = 0; x < place.area.columns; ++x) {
      const std::array<double, 3> rgb = expected(x, y);
      for (int k = 0; k < 3; ++k) {
        std::byte& found = view.at(0, place.area.y + y, 3 * (place.area.x + x) + k);
        ASSERT_NEAR(static_cast<int>(found), rgb[to == PixelFormat::Rgb ? k : 2 - k], tolerance)
            << info(from).name << ' ' << x << ' ' << y << ' ' << k;
        found = std::byte{kUntouched};
      }
    }
  }
  EXPECT_EQ(std::count(view.bytes.begin(), view.bytes.end(), std::byte{kUntouched}),
            static_cast<std::ptrdiff_t>(view.bytes.size()));
}

// Half of a count is the rounding to 8 bit; the rest is the loss of coefficients in Q14.
TEST(WriteTile, ConvertsYuvLikeDoublePrecision) {
  constexpr double kTolerance = 0.53;
  const SampledTile tile = noise();
  for (const PixelFormatInfo& facts : kPixelFormats) {
    if (!is_yuv(facts.format)) continue;
    for (const ColourMatrix matrix : {ColourMatrix::Bt601, ColourMatrix::Bt709}) {
      for (const ColourRange range : {ColourRange::Limited, ColourRange::Full}) {
        for (const PixelFormat to : {PixelFormat::Rgb, PixelFormat::Bgr}) {
          for_each_place(true, [&](const TilePlace& place) {
            expect_colours(tile, facts.format, {matrix, range}, to, place, kTolerance,
                           [&](int x, int y) {
                             return to_rgb(yuv_at(tile, facts.format, x, y), {matrix, range});
                           });
          });
        }
      }
    }
  }
}

TEST(WriteTile, ReordersColours) {
  const SampledTile tile = noise();
  for (const PixelFormat from : {PixelFormat::Rgb, PixelFormat::Bgr, PixelFormat::Bgra}) {
    for (const PixelFormat to : {PixelFormat::Rgb, PixelFormat::Bgr}) {
      for_each_place(true, [&](const TilePlace& place) {
        expect_colours(tile, from, {}, to, place, 0, [&](int x, int y) {
          const int samples = from == PixelFormat::Bgra ? 4 : 3;
          const std::uint8_t* const pixel = &tile.planes[0][(y * kTile + x) * samples];
          const bool red_first = from == PixelFormat::Rgb;
          return std::array{double(pixel[red_first ? 0 : 2]), double(pixel[1]),
                            double(pixel[red_first ? 2 : 0])};
        });
      });
    }
  }
}

/// Black of a sample, written down by hand, since the product uses the same tables.
std::byte black_of(PixelFormat format, ColourRange range, std::size_t plane, int byte) {
  if (!is_yuv(format)) return std::byte{0};
  const bool chroma =
      plane > 0 || (is_packed_yuv(format) && byte % 2 == (format == PixelFormat::Yuyv ? 1 : 0));
  if (chroma) return std::byte{128};
  return std::byte{static_cast<unsigned char>(range == ColourRange::Limited ? 16 : 0)};
}

TEST(ClearArea, MakesItBlackAndNothingElse) {
  for (const PixelFormatInfo& facts : kPixelFormats) {
    SCOPED_TRACE(facts.name);
    for (const ColourRange range : {ColourRange::Limited, ColourRange::Full}) {
      for_each_place(!is_yuv(facts.format), [&](const TilePlace& place) {
        BlankView found(facts.format, place.width, place.height);
        BlankView expected(facts.format, place.width, place.height);
        found.picture.colour_space.range = range;
        clear_area(found.picture, place.area);
        for (std::size_t n = 0; n < facts.plane_count(); ++n) {
          const PlaneInfo& plane = facts.planes[n];
          const int pixel = plane.samples * facts.bytes_per_sample();
          const int left = (place.area.x >> plane.shift_x) * pixel;
          for (int y = 0; y < place.area.rows >> plane.shift_y; ++y) {
            for (int k = 0; k < (place.area.columns >> plane.shift_x) * pixel; ++k) {
              expected.at(n, (place.area.y >> plane.shift_y) + y, left + k) =
                  black_of(facts.format, range, n, left + k);
            }
          }
        }
        EXPECT_EQ(found.bytes, expected.bytes);
      });
    }
  }
}

TEST(ClearUndefined, LeavesWhatIsDefined) {
  CoordinateTile coordinates{};
  std::mt19937 random(2);
  for (CoordinateRow& row : coordinates) {
    for (Coordinate& c : row) c.u = std::array{0, kBlind, kOutside, 500}[random() % 4];
  }
  for (const PixelFormat format : {PixelFormat::Rgb, PixelFormat::Bgr}) {
    for_each_place(true, [&](const TilePlace& place) {
      BlankView found(format, place.width, place.height),
          expected(format, place.width, place.height);
      clear_undefined(coordinates, found.picture, place.area);
      for (int y = 0; y < place.area.rows; ++y) {
        for (int x = 0; x < place.area.columns; ++x) {
          const std::int32_t u = coordinates[y][x].u;
          if (u != kBlind && u != kOutside) continue;
          for (int k = 0; k < 3; ++k) {
            expected.at(0, place.area.y + y, 3 * (place.area.x + x) + k) = std::byte{0};
          }
        }
      }
      EXPECT_EQ(found.bytes, expected.bytes);
    });
  }
}

}  // namespace
}  // namespace orbwatch::remap
